#include "runtime/stress/stress_triangles.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/stages/voxelize.hpp"
#include "runtime/stress/occupancy.hpp"
#include "runtime/stress/stress_random.hpp"

namespace voxelume {
namespace {

constexpr int kVoxel = 4096;
constexpr int kRegionUnits = kRegion * kVoxel;
constexpr int kBricksOfRegion = kRegion / kBrickSize;
constexpr int kRegionsAlong = 8;

/// The occupancy of a region: masks of the leaves of its bricks, x fastest.
using RegionMasks = std::vector<uint64_t>;

glm::ivec3 any_point(StressRandom& random, const glm::ivec3& middle, int reach) {
    glm::ivec3 p;
    for (int a = 0; a < 3; ++a)
        p[a] = std::clamp(middle[a] + int(random.between(-reach, reach)), 1, kRegionUnits - 1);
    return p;
}

glm::ivec3 multiple_of(const glm::ivec3& p, int step) {
    return glm::clamp((p + step / 2) / step * step, glm::ivec3(step),
                      glm::ivec3(kRegionUnits - step));
}

void turn_axes(TriangleOnLattice& t, StressRandom& random) {
    const int turns = int(random.below(3));
    for (glm::ivec3& p : t)
        for (int i = 0; i < turns; ++i) p = {p.y, p.z, p.x};
}

/// Longer than wide by 10^4 and more.
TriangleOnLattice sliver(StressRandom& random, const glm::ivec3& middle) {
    const glm::ivec3 half(int(random.between(-15, 15)) * kVoxel, int(random.between(-61000, 61000)),
                          int(random.between(-61000, 61000)));
    const glm::ivec3 low(1), high(kRegionUnits - 1);
    return {glm::clamp(middle - half, low, high), glm::clamp(middle + half, low, high),
            any_point(random, middle, 4)};
}

/// In a grid plane, or with corners units off it.
TriangleOnLattice in_plane(StressRandom& random, const glm::ivec3& middle, int tilt) {
    TriangleOnLattice t;
    for (glm::ivec3& p : t) {
        p = any_point(random, middle, 20 * kVoxel);
        p.z = middle.z / kVoxel * kVoxel + int(random.between(-tilt, tilt));
    }
    turn_axes(t, random);
    return t;
}

/// A segment or a point.
TriangleOnLattice without_area(StressRandom& random, const glm::ivec3& middle) {
    const glm::ivec3 step = any_point(random, glm::ivec3(0), 3 * kVoxel) - 1;
    const glm::ivec3 a = glm::clamp(middle, glm::ivec3(1), glm::ivec3(kRegionUnits / 2));
    switch (random.below(4)) {
        case 0:
            return {a, a, a};
        case 1:
            return {a, a, any_point(random, a, 15 * kVoxel)};
        case 2:
            return {multiple_of(a, kVoxel), multiple_of(a, kVoxel), multiple_of(a, kVoxel)};
        default:
            return {a, a + step, a + step * int(random.between(2, 6))};
    }
}

/// Sets the bits of a row of voxels in a region.
void set_row(RegionMasks& masks, const VoxelRow& row, int y, int z) {
    for (int64_t x = std::max<int64_t>(row.first, 0); x <= std::min<int64_t>(row.last, kRegion - 1);
         ++x) {
        const glm::ivec3 v(int(x), y, z);
        const VoxelPlace place(v);
        masks[64 * brick_number(v / 16, glm::ivec3(kBricksOfRegion)) + place.leaf] |= place.bit;
    }
}

RegionMasks exact_masks(const TriangleOnLattice& t) {
    RegionMasks masks(64 * kBricksOfRegion * kBricksOfRegion * kBricksOfRegion, 0);
    const glm::ivec3 low = glm::min(glm::min(t[0], t[1]), t[2]) - 1;
    const glm::ivec3 high = glm::max(glm::max(t[0], t[1]), t[2]);
    for (int z = std::max(0, low.z / kVoxel); z <= std::min(kRegion - 1, high.z / kVoxel); ++z)
        for (int y = std::max(0, low.y / kVoxel); y <= std::min(kRegion - 1, high.y / kVoxel); ++y)
            set_row(masks, exact_row(t, y, z), y, z);
    return masks;
}

/// Where region i of a grid begins, in voxels.
glm::ivec3 region_start(uint64_t i) {
    const int n = int(i);
    return glm::ivec3(n % kRegionsAlong, n / kRegionsAlong % kRegionsAlong,
                      n / (kRegionsAlong * kRegionsAlong)) *
           kRegion;
}

/// The masks of a region of the device's grid.
RegionMasks region_of(const ReadOccupancy& occupancy, const glm::ivec3& first) {
    RegionMasks all;
    for (glm::ivec3 b{0}; b.z < kBricksOfRegion; ++b.z)
        for (b.y = 0; b.y < kBricksOfRegion; ++b.y)
            for (b.x = 0; b.x < kBricksOfRegion; ++b.x) {
                const auto masks = occupancy.masks(first / kBrickSize + b);
                all.insert(all.end(), masks.begin(), masks.end());
            }
    return all;
}

std::string describe_difference(const TriangleOnLattice& t, const RegionMasks& device,
                                const RegionMasks& exact) {
    int missing = 0, extra = 0;
    for (size_t i = 0; i < exact.size(); ++i) {
        missing += __builtin_popcountll(exact[i] & ~device[i]);
        extra += __builtin_popcountll(device[i] & ~exact[i]);
    }
    std::string corners;
    for (const glm::ivec3& p : t) corners += fmt::format(" ({},{},{})", p.x, p.y, p.z);
    return fmt::format("corners{} / 4096 voxels: {} voxels missing, {} too many", corners, missing,
                       extra);
}

/// Tries the triangles of one grid.
void try_grid(Voxelizer& voxelizer, uint64_t seed, const StressBatch& batch, StressResult& result) {
    std::vector<TriangleOnLattice> triangles(batch.size);
    Mesh mesh;
    for (size_t i = 0; i < batch.size; ++i) {
        triangles[i] = stress_triangle(seed, batch.start + i);
        const auto corner = uint32_t(mesh.positions.size());
        for (const glm::ivec3& p : triangles[i])  // exact floats: below 2^21 units
            mesh.positions.push_back(glm::vec3(p + region_start(i) * kVoxel) / float(kVoxel));
        mesh.triangles.emplace_back(corner, corner + 1, corner + 2);
    }
    GridFrame frame;
    frame.size = glm::ivec3(kRegion * kRegionsAlong);
    VoxelizeOptions options;
    options.surface = Surface::cubes;
    options.set = VoxelSet::supercover;
    const BrickGrid grid = voxelizer.voxelize(mesh, glm::dmat4(1), frame, options);
    std::vector<RegionMasks> exact(batch.end);
    for_each_in_parallel(batch.end - batch.first, [&](uint64_t i) {
        exact[batch.first + i] = exact_masks(triangles[batch.first + i]);
    });
    const ReadOccupancy occupancy(grid);
    for (size_t i = batch.first; i < batch.end; ++i) {
        const RegionMasks device = region_of(occupancy, region_start(i));
        for (const uint64_t mask : exact[i]) result.cells += __builtin_popcountll(mask);
        if (device != exact[i])
            note_mismatch(result, batch.start + i,
                          [&] { return describe_difference(triangles[i], device, exact[i]); });
    }
    result.cases += batch.end - batch.first;
}

}  // namespace

TriangleOnLattice stress_triangle(uint64_t seed, uint64_t number) {
    StressRandom random(seed, 100, number);
    const glm::ivec3 middle = any_point(random, glm::ivec3(kRegionUnits / 2), 6 * kVoxel);
    const auto corners = [&](int reach, int step) {
        TriangleOnLattice t;
        for (glm::ivec3& p : t) p = multiple_of(any_point(random, middle, reach), step);
        return t;
    };
    switch (number / kTrianglesOfOneGrid % 8) {
        case 0:
            return corners(4 * kVoxel, 1);
        case 1:
            return sliver(random, middle);
        case 2:
            return in_plane(random, middle, 1);
        case 3:
            return in_plane(random, middle, 0);
        case 4:
            return corners(8 * kVoxel, kVoxel / 2);
        case 5:
            return corners(kRegionUnits, 1);
        case 6:
            return without_area(random, middle);
        default:
            return corners(12 * kVoxel, kVoxel);
    }
}

StressResult stress_triangles(const StressRun& run) {
    Voxelizer voxelizer(run.device);
    StressResult result;
    for_each_batch(run, kTrianglesOfOneGrid,
                   [&](const StressBatch& batch) { try_grid(voxelizer, run.seed, batch, result); });
    return result;
}

}  // namespace voxelume
