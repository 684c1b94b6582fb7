// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/stress/long_triangles.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "runtime/grid/grid_frame.hpp"

namespace voxelume {
namespace {

/// The regions of long triangles before they are turned; the longest axis is x. They have some 4000
/// bricks each, because the device visits all of a triangle's box. No axis of the grid exceeds
/// 16384.
constexpr std::array kLongGrids = {
    TriangleGrid{{4096, 48, 64}, {1, 32, 16}},
    TriangleGrid{{2048, 128, 64}, {2, 16, 16}},
    TriangleGrid{{16384, 32, 32}, {1, 16, 32}},
    TriangleGrid{{512, 512, 64}, {8, 4, 16}},
};

/// A grid before its axes are turned, and the number of turns.
struct LongGrid {
    const TriangleGrid& grid;
    int turns;
};

LongGrid long_grid(uint64_t number) {
    return {kLongGrids[number % kLongGrids.size()], int(number % 3)};
}

/// Makes narrow triangles along x. The number of voxels that one meets is about its length, or its
/// length times a small width.
class LongTriangle {
  public:
    LongTriangle(StressRandom& random, const TriangleGrid& grid)
        : random_(random),
          units_(grid.region * kUnitsPerVoxel),
          // Floats hold 24 bits: every lattice unit of 4096 voxels, every fourth unit of 16384.
          step_(std::max(1, grid.size().x / 4096)) {}

    TriangleOnLattice any() {
        const glm::ivec3 a = point(1, units_.x / 8), b = point(units_.x * 7 / 8, units_.x);
        switch (random_.below(9)) {
            case 0:
                return held({a, b, next_to(a, b, 4)});
            case 1:
                return held({a, b, next_to(a, b, width())});
            case 2:
                return held({a, b, near(b, kUnitsPerVoxel)});
            case 3:
                return in_plane(a, b, 0);
            case 4:
                return in_plane(a, b, 1);
            case 5:
                return on_corners(a, b);
            case 6:
                return without_area(a, b);
            case 7:
                return through_a_bricks_corner();
            default:
                return about_128_voxels(a);
        }
    }

  private:
    /// The distance of a corner from the longest edge at which the triangle meets some 10^4 voxels.
    int width() const { return std::min(16, 65536 * kUnitsPerVoxel / units_.x) * kUnitsPerVoxel; }

    glm::ivec3 point(int low_x, int high_x) {
        return {int(random_.between(low_x, high_x)), int(random_.between(1, units_.y - 1)),
                int(random_.between(1, units_.z - 1))};
    }
    glm::ivec3 near(const glm::ivec3& p, int reach) {
        glm::ivec3 q;
        for (int axis = 0; axis < 3; ++axis)
            q[axis] = p[axis] + int(random_.between(-reach, reach));
        return q;
    }
    /// A point at most `reach` from a point of the segment along each axis.
    glm::ivec3 next_to(const glm::ivec3& a, const glm::ivec3& b, int reach) {
        const int64_t part = random_.between(0, 1 << 16);
        glm::ivec3 p;
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = a[axis] + int(int64_t(b[axis] - a[axis]) * part >> 16);
        return near(p, reach);
    }
    TriangleOnLattice in_plane(const glm::ivec3& a, const glm::ivec3& b, int tilt) {
        const int axis = 1 + int(random_.below(2));
        TriangleOnLattice t = {a, b, next_to(a, b, width())};
        const int plane = std::max(kUnitsPerVoxel, a[axis] / kUnitsPerVoxel * kUnitsPerVoxel);
        for (glm::ivec3& p : t) p[axis] = plane + int(random_.between(-tilt, tilt));
        return held(t);
    }
    TriangleOnLattice on_corners(const glm::ivec3& a, const glm::ivec3& b) {
        TriangleOnLattice t = {a, b, next_to(a, b, width())};
        for (glm::ivec3& p : t)
            p = glm::clamp(p / kUnitsPerVoxel, glm::ivec3(1), units_ / kUnitsPerVoxel - 1) *
                kUnitsPerVoxel;
        return t;
    }
    /// A triangle whose corners lie on one line.
    TriangleOnLattice without_area(const glm::ivec3& a, const glm::ivec3& b) {
        const int parts = int(random_.between(2, 9)), part = int(random_.between(0, parts));
        glm::ivec3 first = a, way = (b - a) / parts;
        first.x = std::max(step_, a.x / step_ * step_), way.x = way.x / step_ * step_;
        return {first, first + way * parts, first + way * part};
    }
    /// A triangle through a brick's corner. It meets some of the bricks around the corner nowhere
    /// else.
    TriangleOnLattice through_a_bricks_corner() {
        const int before = 1 << random_.below(11), behind = 1 << random_.below(11);
        glm::ivec3 corner, way;
        for (int axis = 0; axis < 3; ++axis) {
            const int bricks = units_[axis] / (kBrickSize * kUnitsPerVoxel);
            corner[axis] = int(random_.between(1, bricks - 1)) * kBrickSize * kUnitsPerVoxel;
            const int room = std::min(corner[axis], units_[axis] - corner[axis]) - step_;
            const int maximum = room / std::max(before, behind);
            way[axis] = int(random_.between(axis == 0 ? maximum / 2 : -maximum, maximum));
        }
        way.x = way.x / step_ * step_;
        const glm::ivec3 a = corner - way * before, b = corner + way * behind;
        return held({a, b, next_to(a, b, width())});
    }
    /// A triangle with a length on either side of the limit from which planes are computed in 128
    /// bits.
    TriangleOnLattice about_128_voxels(const glm::ivec3& a) {
        glm::ivec3 b = near(a, 2 * kUnitsPerVoxel);
        b.x = a.x + 128 * kUnitsPerVoxel + step_ * int(random_.between(-1, 1));
        return held({a, b, next_to(a, b, width())});
    }
    /// The triangle clamped to the region, with whole steps along x.
    TriangleOnLattice held(TriangleOnLattice t) const {
        for (glm::ivec3& p : t) {
            p = glm::clamp(p, glm::ivec3(step_, 1, 1), units_ - glm::ivec3(step_, 1, 1));
            p.x = p.x / step_ * step_;
        }
        return t;
    }

    StressRandom& random_;
    glm::ivec3 units_;
    int step_;
};

}  // namespace

TriangleGrid grid_of_long_triangles(uint64_t grid) {
    const LongGrid chosen = long_grid(grid);
    return {turned(chosen.grid.region, chosen.turns), turned(chosen.grid.counts, chosen.turns)};
}

TriangleOnLattice long_triangle(StressRandom& random, uint64_t grid) {
    const LongGrid chosen = long_grid(grid);
    TriangleOnLattice t = LongTriangle(random, chosen.grid).any();
    for (glm::ivec3& p : t) p = turned(p, chosen.turns);
    return t;
}

}  // namespace voxelume
