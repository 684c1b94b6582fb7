// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/stress/triangle_classes.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "runtime/verify/stress/giant_triangles.hpp"
#include "runtime/verify/stress/long_triangles.hpp"
#include "runtime/verify/stress/stress_random.hpp"

namespace voxelume {
namespace {

constexpr int kRegion = 48;  // voxels along the regions of all classes but the last two
constexpr int kRegionUnits = kRegion * kUnitsPerVoxel;
constexpr uint64_t kLongClass = 8, kGiantClass = 9;

/// The class of triangle `number`, and the grid of that class that contains it.
struct ClassGrid {
    uint64_t kind, grid;
};

ClassGrid class_of(uint64_t number) {
    const uint64_t grid = number / kTrianglesOfOneGrid;
    return {grid % kTriangleClasses, grid / kTriangleClasses};
}

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
    for (glm::ivec3& p : t) p = turned(p, turns);
}

/// A triangle at least 10^4 times as long as wide.
TriangleOnLattice sliver(StressRandom& random, const glm::ivec3& middle) {
    const glm::ivec3 half(int(random.between(-15, 15)) * kUnitsPerVoxel,
                          int(random.between(-61000, 61000)), int(random.between(-61000, 61000)));
    const glm::ivec3 low(1), high(kRegionUnits - 1);
    return {glm::clamp(middle - half, low, high), glm::clamp(middle + half, low, high),
            any_point(random, middle, 4)};
}

/// A triangle in a grid plane, or with corners up to `tilt` units off it.
TriangleOnLattice in_plane(StressRandom& random, const glm::ivec3& middle, int tilt) {
    TriangleOnLattice t;
    for (glm::ivec3& p : t) {
        p = any_point(random, middle, 20 * kUnitsPerVoxel);
        p.z = middle.z / kUnitsPerVoxel * kUnitsPerVoxel + int(random.between(-tilt, tilt));
    }
    turn_axes(t, random);
    return t;
}

/// A triangle that is a segment or a point.
TriangleOnLattice without_area(StressRandom& random, const glm::ivec3& middle) {
    const glm::ivec3 step = any_point(random, glm::ivec3(0), 3 * kUnitsPerVoxel) - 1;
    const glm::ivec3 a = glm::clamp(middle, glm::ivec3(1), glm::ivec3(kRegionUnits / 2));
    switch (random.below(4)) {
        case 0:
            return {a, a, a};
        case 1:
            return {a, a, any_point(random, a, 15 * kUnitsPerVoxel)};
        case 2:
            return {multiple_of(a, kUnitsPerVoxel), multiple_of(a, kUnitsPerVoxel),
                    multiple_of(a, kUnitsPerVoxel)};
        default:
            return {a, a + step, a + step * int(random.between(2, 6))};
    }
}

}  // namespace

TriangleGrid grid_of_triangle(uint64_t number) {
    const auto [kind, grid] = class_of(number);
    if (kind == kLongClass) return grid_of_long_triangles(grid);
    if (kind == kGiantClass) return grid_of_giant_triangles(grid);
    return {glm::ivec3(kRegion), glm::ivec3(8)};
}

TriangleOnLattice stress_triangle(uint64_t seed, uint64_t number) {
    StressRandom random(seed, 100, number);
    const auto [kind, grid] = class_of(number);
    if (kind == kLongClass) return long_triangle(random, grid);
    if (kind == kGiantClass) return giant_triangle(random, grid, number % kTrianglesOfOneGrid);
    const glm::ivec3 middle = any_point(random, glm::ivec3(kRegionUnits / 2), 6 * kUnitsPerVoxel);
    const auto corners = [&](int reach, int step) {
        TriangleOnLattice t;
        for (glm::ivec3& p : t) p = multiple_of(any_point(random, middle, reach), step);
        return t;
    };
    switch (kind) {
        case 0:
            return corners(4 * kUnitsPerVoxel, 1);
        case 1:
            return sliver(random, middle);
        case 2:
            return in_plane(random, middle, 1);
        case 3:
            return in_plane(random, middle, 0);
        case 4:
            return corners(8 * kUnitsPerVoxel, kUnitsPerVoxel / 2);
        case 5:
            return corners(kRegionUnits, 1);
        case 6:
            return without_area(random, middle);
        default:
            return corners(12 * kUnitsPerVoxel, kUnitsPerVoxel);
    }
}

}  // namespace voxelume
