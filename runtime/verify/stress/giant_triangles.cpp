// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/stress/giant_triangles.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace voxelume {
namespace {

constexpr int kFarthest = 16384;  // maximum distance from the grid's origin, voxels

/// The distance between corners' coordinates, in lattice units: floats hold 24 bits.
constexpr int kStep = 4;

/// The grid before its axes are turned.
constexpr TriangleGrid kPillar = {{48, 48, 32}, {1, 1, int(kTrianglesOfOneGrid)}};
static_assert(uint64_t(kPillar.region.z) * kTrianglesOfOneGrid == kFarthest);

int turns_of(uint64_t grid) {
    return int(grid % 3);
}

/// True if the triangle's plane rises by more than a quarter, so that it might leave its region
/// upwards.
bool is_steep(const TriangleOnLattice& t) {
    const auto side = [&](size_t i, int axis) { return int64_t{t[i][axis]} - t[0][axis]; };
    const auto area = [&](int u, int w) {
        return std::abs(side(1, u) * side(2, w) - side(1, w) * side(2, u));
    };
    return 4 * (area(1, 2) + area(2, 0)) > area(0, 1);
}

/// Makes triangles around the middle of their region. Their planes come close to it.
class GiantTriangle {
  public:
    /// Makes triangles that rise by at most `rise` voxels on the way to a corner.
    GiantTriangle(StressRandom& random, int rise) : random_(random) {
        const std::array<int, 4> heights = {0, 1, kUnitsPerVoxel / kStep,
                                            rise * (kUnitsPerVoxel / kStep)};
        height_ = heights[random.below(heights.size())];
    }

    TriangleOnLattice any() {
        TriangleOnLattice t = corners();
        while (is_steep(t))
            for (glm::ivec3& p : t) p.z = p.z / (2 * kStep) * kStep;
        return t;
    }

  private:
    TriangleOnLattice corners() {
        const glm::ivec3 a = far(), b = far();
        switch (random_.below(3)) {
            case 0:  // the triangle contains the middle
                return {a, b, near(-(a + b))};
            case 1:  // an edge passes the middle
                return {a, near(-a), b};
            default:  // a corner is at the middle
                return {near(glm::ivec3(0)), a, b};
        }
    }
    int steps(int maximum) { return kStep * int(random_.between(-maximum, maximum)); }
    glm::ivec3 far() {
        constexpr int kFar = (kFarthest / 2 - 64) * (kUnitsPerVoxel / kStep);
        return {steps(kFar), steps(kFar), steps(height_)};
    }
    glm::ivec3 near(const glm::ivec3& p) {
        constexpr int kNear = 8 * (kUnitsPerVoxel / kStep);
        return p + glm::ivec3(steps(kNear), steps(kNear), steps(std::min(height_, 256)));
    }

    StressRandom& random_;
    int height_ = 0;  // maximum height of corners above the middle, in steps
};

}  // namespace

TriangleGrid grid_of_giant_triangles(uint64_t grid) {
    const int turns = turns_of(grid);
    return {turned(kPillar.region, turns), turned(kPillar.counts, turns)};
}

TriangleOnLattice giant_triangle(StressRandom& random, uint64_t grid, uint64_t number) {
    const int above = kFarthest - kPillar.start(number).z - kPillar.region.z;
    TriangleOnLattice t = GiantTriangle(random, std::min(4000, above / 2)).any();
    for (glm::ivec3& p : t) p = turned(p + kPillar.region * kUnitsPerVoxel / 2, turns_of(grid));
    return t;
}

}  // namespace voxelume
