// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/stress/stress_triangles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <glm/common.hpp>

#include "runtime/stages/voxelize/voxelize.hpp"
#include "runtime/verify/exact/exact_thin.hpp"
#include "runtime/verify/exact/occupancy.hpp"
#include "runtime/verify/stress/triangle_classes.hpp"

namespace voxelume {
namespace {

using BrickMasks = std::array<uint64_t, 64>;

/// The voxels of a region, brick by brick.
class ExactVoxels {
  public:
    explicit ExactVoxels(const glm::ivec3& region)
        : bricks_(region / kBrickSize),
          slots_(size_t(bricks_.x) * size_t(bricks_.y) * size_t(bricks_.z), 0),
          masks_(1, BrickMasks{}) {}

    void set(const glm::ivec3& v) {
        uint32_t& slot = slots_[brick_number(v / kBrickSize, bricks_)];
        if (slot == 0) {
            slot = uint32_t(masks_.size());
            masks_.push_back({});
        }
        const VoxelSlot voxel_slot(v);
        uint64_t& mask = masks_[slot][voxel_slot.leaf];
        count_ += (mask & voxel_slot.bit) == 0;
        mask |= voxel_slot.bit;
    }

    const BrickMasks& masks(const glm::ivec3& brick) const {
        return masks_[slots_[brick_number(brick, bricks_)]];
    }

    uint64_t count() const { return count_; }

  private:
    glm::ivec3 bricks_;
    std::vector<uint32_t> slots_;  // 0 for a brick without voxels
    std::vector<BrickMasks> masks_;
    uint64_t count_ = 0;
};

VoxelRow within(const VoxelRow& row, int size) {
    return {std::max<int64_t>(row.first, 0), std::min<int64_t>(row.last, size - 1)};
}

ExactVoxels exact_supercover(const TriangleOnLattice& t, const glm::ivec3& region) {
    ExactVoxels voxels(region);
    const int low = std::min({t[0].z, t[1].z, t[2].z}) - 1;
    const int high = std::max({t[0].z, t[1].z, t[2].z});
    for (int z = std::max(0, low / kUnitsPerVoxel);
         z <= std::min(region.z - 1, high / kUnitsPerVoxel); ++z) {
        const VoxelRow rows = within(exact_rows(t, z), region.y);
        for (int64_t y = rows.first; y <= rows.last; ++y) {
            const VoxelRow row = within(exact_row(t, int(y), z), region.x);
            for (int64_t x = row.first; x <= row.last; ++x) voxels.set({int(x), int(y), z});
        }
    }
    return voxels;
}

ExactVoxels exact_voxels(VoxelSet set, const TriangleOnLattice& t, const glm::ivec3& region) {
    if (set == VoxelSet::supercover) return exact_supercover(t, region);
    ExactVoxels voxels(region);
    for (const glm::ivec3& v : exact_thin(t, region)) voxels.set(v);
    return voxels;
}

/// The comparison of a triangle's region in the device's grid with the exact voxels.
struct Comparison {
    uint64_t cells = 0, missing = 0, extra = 0;
};

Comparison compare(const ExactVoxels& voxels, const TriangleGrid& grid, uint64_t number,
                   const ReadOccupancy& occupancy) {
    const glm::ivec3 first = grid.start(number) / kBrickSize, count = grid.region / kBrickSize;
    Comparison c{voxels.count(), 0, 0};
    for (glm::ivec3 b{0}; b.z < count.z; ++b.z)
        for (b.y = 0; b.y < count.y; ++b.y)
            for (b.x = 0; b.x < count.x; ++b.x) {
                const BrickMasks device = occupancy.masks(first + b);
                const BrickMasks& exact = voxels.masks(b);
                if (device == exact) continue;
                for (size_t i = 0; i < exact.size(); ++i) {
                    c.missing += uint64_t(std::popcount(exact[i] & ~device[i]));
                    c.extra += uint64_t(std::popcount(device[i] & ~exact[i]));
                }
            }
    return c;
}

std::string describe(const TriangleOnLattice& t, const Comparison& c) {
    std::string corners;
    for (const glm::ivec3& p : t) corners += fmt::format(" ({},{},{})", p.x, p.y, p.z);
    return fmt::format("corners{} / 4096 voxels: {} voxels missing, {} too many", corners,
                       c.missing, c.extra);
}

/// Tries the triangles of one grid.
void try_grid(Voxelizer& voxelizer, VoxelSet set, uint64_t seed, const StressBatch& batch,
              StressResult& result) {
    const TriangleGrid grid = grid_of_triangle(batch.start);
    std::vector<TriangleOnLattice> triangles(batch.size);
    Mesh mesh;
    for (size_t i = 0; i < batch.size; ++i) {
        triangles[i] = stress_triangle(seed, batch.start + i);
        const auto corner = uint32_t(mesh.positions.size());
        for (const glm::ivec3& p : triangles[i])  // the floats are exact
            mesh.positions.push_back(glm::vec3(p + grid.start(i) * kUnitsPerVoxel) /
                                     float(kUnitsPerVoxel));
        mesh.triangles.emplace_back(corner, corner + 1, corner + 2);
    }
    GridFrame frame;
    frame.size = grid.size();
    VoxelizeOptions options;
    options.surface = Surface::cubes;
    options.set = set;
    const ReadOccupancy occupancy(voxelizer.voxelize(mesh, glm::dmat4(1), frame, options));
    std::vector<Comparison> compared(batch.size);
    for_each_in_parallel(batch.end - batch.first, [&](uint64_t i) {
        const size_t n = batch.first + i;
        compared[n] = compare(exact_voxels(set, triangles[n], grid.region), grid, n, occupancy);
    });
    for (size_t i = batch.first; i < batch.end; ++i) {
        result.cells += compared[i].cells;
        if (compared[i].missing + compared[i].extra > 0)
            note_mismatch(result, batch.start + i,
                          [&] { return describe(triangles[i], compared[i]); });
    }
    result.cases += batch.end - batch.first;
}

}  // namespace

StressResult stress_triangles(VoxelSet set, const StressRun& run) {
    Voxelizer voxelizer(run.device);
    StressResult result;
    for_each_batch(run, kTrianglesOfOneGrid, [&](const StressBatch& batch) {
        try_grid(voxelizer, set, run.seed, batch, result);
    });
    return result;
}

}  // namespace voxelume
