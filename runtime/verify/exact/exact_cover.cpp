// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/exact/exact_cover.hpp"

#include <algorithm>

namespace voxelume {
namespace {

__extension__ using Wide = __int128;

constexpr int64_t kUnit = kUnitsPerVoxel;

/// The closed range, along one axis, of the voxels whose cubes contain any of the added points.
class RowBounds {
  public:
    /// Adds the point at numerator / denominator lattice units.
    void add(Wide numerator, Wide denominator) {
        if (denominator < 0) numerator = -numerator, denominator = -denominator;
        const Wide per_voxel = denominator * kUnit;
        const Wide floor = numerator / per_voxel - (numerator % per_voxel < 0);
        const bool on_plane = floor * per_voxel == numerator;
        // A point on a plane touches the voxels on both sides of it.
        row_.first = std::min(row_.first, int64_t(floor) - on_plane);
        row_.last = std::max(row_.last, int64_t(floor));
    }
    VoxelRow row() const { return row_; }

  private:
    VoxelRow row_{INT64_MAX, INT64_MIN};
};

/// The prism of a row, in lattice units: y and z from low to high.
struct Prism {
    int64_t low[2], high[2];
};

int64_t at(const glm::ivec3& p, int axis) {
    return p[axis];
}

/// True if an edge meets a plane. The edge moves by `way` across the plane, which lies `to_plane`
/// from the edge's start.
bool is_on_edge(int64_t to_plane, int64_t way) {
    return way > 0 ? to_plane >= 0 && to_plane <= way : to_plane <= 0 && to_plane >= way;
}

/// Adds the points where the edge from a to b passes the prism's sides at y or z (`axis` 1 or 2).
void add_edge(RowBounds& bounds, const Prism& prism, const glm::ivec3& a, const glm::ivec3& b,
              int axis) {
    const int64_t way = at(b, axis) - at(a, axis);
    if (way == 0) return;
    const int other = 3 - axis;
    for (const int64_t side : {prism.low[axis - 1], prism.high[axis - 1]}) {
        const int64_t to_side = side - at(a, axis);  // the point is a + (b - a) to_side / way
        if (!is_on_edge(to_side, way)) continue;
        const int64_t scaled = at(a, other) * way + (at(b, other) - at(a, other)) * to_side;
        const int64_t sign = way > 0 ? 1 : -1;
        if (scaled * sign < prism.low[other - 1] * way * sign ||
            scaled * sign > prism.high[other - 1] * way * sign)
            continue;
        bounds.add(Wide(at(a, 0)) * way + Wide(at(b, 0) - at(a, 0)) * to_side, way);
    }
}

/// Twice the signed area of (a, b, p), seen along x.
int64_t turn(const glm::ivec3& a, const glm::ivec3& b, int64_t y, int64_t z) {
    return (at(b, 1) - at(a, 1)) * (z - at(a, 2)) - (at(b, 2) - at(a, 2)) * (y - at(a, 1));
}

}  // namespace

VoxelRow exact_row(const TriangleOnLattice& t, int y, int z) {
    const Prism prism{{y * kUnit, z * kUnit}, {(y + 1) * kUnit, (z + 1) * kUnit}};
    RowBounds bounds;
    for (size_t i = 0; i < 3; ++i) {
        const glm::ivec3& p = t[i];
        if (p.y >= prism.low[0] && p.y <= prism.high[0] && p.z >= prism.low[1] &&
            p.z <= prism.high[1])
            bounds.add(p.x, 1);
        for (const int axis : {1, 2}) add_edge(bounds, prism, p, t[(i + 1) % 3], axis);
    }
    const int64_t area = turn(t[0], t[1], t[2].y, t[2].z);
    if (area == 0) return bounds.row();
    for (const int64_t py : {prism.low[0], prism.high[0]})
        for (const int64_t pz : {prism.low[1], prism.high[1]}) {
            const int64_t w[3] = {turn(t[1], t[2], py, pz), turn(t[2], t[0], py, pz),
                                  turn(t[0], t[1], py, pz)};
            if (area > 0 ? std::min({w[0], w[1], w[2]}) < 0 : std::max({w[0], w[1], w[2]}) > 0)
                continue;
            bounds.add(Wide(w[0]) * t[0].x + Wide(w[1]) * t[1].x + Wide(w[2]) * t[2].x, area);
        }
    return bounds.row();
}

VoxelRow exact_rows(const TriangleOnLattice& t, int z) {
    const int64_t low = z * kUnit, high = low + kUnit;
    RowBounds bounds;  // bounds of the corners of the part of the triangle in the layer
    for (size_t i = 0; i < 3; ++i) {
        const glm::ivec3 &a = t[i], &b = t[(i + 1) % 3];
        if (a.z >= low && a.z <= high) bounds.add(a.y, 1);
        const int64_t way = at(b, 2) - at(a, 2);
        if (way == 0) continue;
        for (const int64_t side : {low, high})
            if (is_on_edge(side - a.z, way))
                bounds.add(Wide(a.y) * way + Wide(at(b, 1) - at(a, 1)) * (side - a.z), way);
    }
    return bounds.row();
}

}  // namespace voxelume
