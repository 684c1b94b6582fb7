// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/stress/stress_placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "runtime/stages/place/place.hpp"
#include "runtime/verify/exact/occupancy.hpp"
#include "runtime/verify/stress/device_walks.hpp"
#include "runtime/verify/stress/stress_random.hpp"

namespace voxelume {
namespace {

constexpr int kLumpRegion = 48;  // voxels along the edge of the region of one map's lump
constexpr int kRegionsAlong = 3;
constexpr uint64_t kMapsOfOneWorld = kRegionsAlong * kRegionsAlong * kRegionsAlong;
constexpr double kOrigin = -24;  // origin of the world, metres and voxels

const GridFrame kObject{.origin = {-4, -3, -4}, .voxel_edge = {1, 1, 1}, .size = {9, 6, 8}};

GridFrame world_frame() {
    return {.origin = glm::dvec3(kOrigin),
            .voxel_edge = glm::dvec3(1),
            .size = glm::ivec3(kLumpRegion * kRegionsAlong)};
}

/// The start of the region of the i-th map of a world, in voxels.
glm::ivec3 region_start(uint64_t i) {
    const int n = int(i);
    return glm::ivec3(n % kRegionsAlong, n / kRegionsAlong % kRegionsAlong,
                      n / (kRegionsAlong * kRegionsAlong)) *
           kLumpRegion;
}

VoxelBits random_lump(uint64_t seed) {
    VoxelBits lump(kObject.size);
    StressRandom random(seed, 300, 0);
    for (glm::ivec3 v{0}; v.z < kObject.size.z; ++v.z)
        for (v.y = 0; v.y < kObject.size.y; ++v.y)
            for (v.x = 0; v.x < kObject.size.x; ++v.x)
                if (random.below(3) != 0) lump.set(v);
    return lump;
}

/// A random choice of the 48 turns and mirrors of a cube, times powers of two.
StressMap quarter_turns(StressRandom& random) {
    int axes[3] = {0, 1, 2};
    std::swap(axes[0], axes[random.below(3)]);
    std::swap(axes[1], axes[1 + random.below(2)]);
    StressMap map;
    map.is_exact = true;
    map.world_from_object = glm::dmat4(0.0);
    for (int a = 0; a < 3; ++a) {
        map.world_from_object[a][axes[a]] = random.sign() * double(1 << random.below(2));
        map.world_from_object[3][a] = double(random.between(-16, 16)) / 4;
    }
    map.world_from_object[3][3] = 1;
    return map;
}

/// A turn by a quaternion of small integers, followed by a general affine map.
StressMap any_map(StressRandom& random) {
    glm::dvec4 q(0);
    while (q == glm::dvec4(0))
        for (int i = 0; i < 4; ++i) q[i] = double(random.between(-5, 5));
    const double n = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    const glm::dmat3 turn = glm::dmat3(n - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.z * q.w),
                                       2 * (q.x * q.z - q.y * q.w), 2 * (q.x * q.y - q.z * q.w),
                                       n - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.x * q.w),
                                       2 * (q.x * q.z + q.y * q.w), 2 * (q.y * q.z - q.x * q.w),
                                       n - 2 * (q.x * q.x + q.y * q.y)) /
                            n;
    glm::dmat3 stretch(0.0);
    for (int a = 0; a < 3; ++a) stretch[a][a] = random.sign() * random.uniform(1.7, 2.3);
    stretch[1][0] = random.uniform(-0.3, 0.3);
    StressMap map;
    map.world_from_object = glm::dmat4(turn * stretch);
    for (int a = 0; a < 3; ++a) map.world_from_object[3][a] = random.uniform(-3, 3);
    return map;
}

/// The position, in the object's voxels, of a world voxel's centre. Doubles have 28 bits more than
/// the fixed point that kernels use.
struct PlacedImage {
    explicit PlacedImage(const glm::dmat4& world_from_object)
        : linear(glm::inverse(glm::dmat3(world_from_object))),
          offset(linear * (glm::dvec3(kOrigin + 0.5) - glm::dvec3(world_from_object[3])) -
                 kObject.origin) {}

    glm::dvec3 of_centre(const glm::ivec3& v) const { return linear * glm::dvec3(v) + offset; }

    glm::dmat3 linear;
    glm::dvec3 offset;
};

glm::ivec3 floor_of(const glm::dvec3& p) {
    return glm::ivec3(p + 1024.0) - 1024;  // the shift makes p positive, so truncation rounds down
}

bool is_set(const VoxelBits& voxels, const glm::ivec3& v) {
    return glm::all(glm::greaterThanEqual(v, glm::ivec3(0))) &&
           glm::all(glm::lessThan(v, voxels.size())) && voxels.is_set(v);
}

/// True if `found` is the value of the voxel at p, or of one that contains p after a move by up to
/// `bound`.
bool is_right(const VoxelBits& lump, const glm::dvec3& p, double bound, bool found) {
    if (is_set(lump, floor_of(p)) == found) return true;
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 moved;
        for (int a = 0; a < 3; ++a) moved[a] = p[a] + (corner >> a & 1 ? bound : -bound);
        if (is_set(lump, floor_of(moved)) == found) return true;
    }
    return false;
}

/// The error of rounding coefficients and offsets to 2^-24: half of that for every step through the
/// world.
constexpr double kRounding = 0x1p-25 * (1 + 3 * kLumpRegion * kRegionsAlong);

/// The number of a region's voxels that differ from what its map makes of the lump.
uint64_t wrong_voxels(const ReadOccupancy& placed, const VoxelBits& lump, const glm::dmat4& map,
                      double bound, const glm::ivec3& start) {
    const PlacedImage image(map);
    std::atomic<uint64_t> wrong{0};
    for_each_in_parallel(uint64_t(kLumpRegion), [&](uint64_t z) {
        uint64_t of_layer = 0;
        for (int y = 0; y < kLumpRegion; ++y)
            for (int x = 0; x < kLumpRegion; ++x) {
                const glm::ivec3 v = start + glm::ivec3(x, y, int(z));
                of_layer += !is_right(lump, image.of_centre(v), bound, placed.is_set(v));
            }
        wrong += of_layer;
    });
    return wrong;
}

std::string text_of(const glm::dmat4& m) {
    std::string text = "columns";
    for (int c = 0; c < 4; ++c) text += fmt::format(" ({},{},{})", m[c][0], m[c][1], m[c][2]);
    return text;
}

}  // namespace

StressMap stress_map(uint64_t seed, uint64_t number) {
    StressRandom random(seed, 301, number);
    return number % 2 == 0 ? quarter_turns(random) : any_map(random);
}

StressResult stress_placement(const StressRun& run) {
    const VoxelBits lump = random_lump(run.seed);
    const BrickGrid grid = cubes_of(run.device, lump, kObject);
    StressResult result;
    for_each_batch(run, kMapsOfOneWorld, [&](const StressBatch& batch) {
        std::vector<PlacedObject> objects;
        for (size_t i = 0; i < batch.size; ++i) {
            glm::dmat4 map = stress_map(run.seed, batch.start + i).world_from_object;
            map[3] += glm::dvec4(region_start(i), 0);
            objects.push_back({.grid = &grid,
                               .world_from_object = map,
                               .object = uint32_t(i),
                               .material_of_group = {0}});
        }
        const ReadOccupancy placed(place(run.device, objects, world_frame()));
        for (size_t i = batch.first; i < batch.end; ++i) {
            const bool is_exact = stress_map(run.seed, batch.start + i).is_exact;
            const uint64_t wrong = wrong_voxels(placed, lump, objects[i].world_from_object,
                                                is_exact ? 0 : kRounding, region_start(i));
            result.cells += kLumpRegion * kLumpRegion * kLumpRegion;
            if (wrong == 0) continue;
            note_mismatch(result, batch.start + i, [&] {
                return fmt::format("{}: {} voxels are wrong", text_of(objects[i].world_from_object),
                                   wrong);
            });
        }
        result.cases += batch.end - batch.first;
    });
    return result;
}

}  // namespace voxelume
