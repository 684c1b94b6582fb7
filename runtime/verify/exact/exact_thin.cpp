// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/exact/exact_thin.hpp"

#include <algorithm>

namespace voxelume {
namespace {

__extension__ using Wide = __int128;

constexpr int64_t kCenter = kUnitsPerVoxel / 2;

/// The axis of the lines, and the two axes across them.
struct RowAxes {
    int along, u, w;
};

template <class Integer>
Integer floor_of(Integer numerator, Integer denominator) {
    return numerator / denominator - (numerator % denominator < 0);
}

/// The first voxel u whose line lies beyond an edge, in the row of lines at `w` lattice units. The
/// edge crosses that row upwards, from `a` to `b`.
int64_t first_beyond(const glm::ivec3& a, const glm::ivec3& b, const RowAxes& axes, int64_t w) {
    const int64_t du = int64_t{b[axes.u]} - a[axes.u], dw = int64_t{b[axes.w]} - a[axes.w];
    const int64_t edge = (a[axes.u] - kCenter) * dw + du * (w - a[axes.w]);
    const int64_t voxel = floor_of(edge, kUnitsPerVoxel * dw);
    const bool is_on_edge = voxel * kUnitsPerVoxel * dw == edge;
    const bool moves_beyond = axes.u < axes.w || du <= 0;
    return is_on_edge && moves_beyond ? voxel : voxel + 1;
}

/// The voxels u of a row whose lines pass the triangle; none if first > last.
VoxelRow lines_of_row(const TriangleOnLattice& t, const RowAxes& axes, int64_t w) {
    VoxelRow row{INT64_MAX, INT64_MIN};
    for (size_t i = 0; i < 3; ++i) {
        const glm::ivec3 &a = t[i], &b = t[(i + 1) % 3];
        const bool ends_above = b[axes.w] > w;
        if ((a[axes.w] > w) == ends_above) continue;
        const int64_t u = ends_above ? first_beyond(a, b, axes, w) : first_beyond(b, a, axes, w);
        row = {std::min(row.first, u), std::max(row.last, u - 1)};
    }
    return row;
}

/// A triangle's plane: normal · p = at.
struct Plane {
    int64_t normal[3];
    Wide at;
};

Plane plane_of(const TriangleOnLattice& t) {
    const auto side = [&](size_t i, int axis) { return int64_t{t[i][axis]} - t[0][axis]; };
    Plane plane{{}, 0};
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, w = (axis + 2) % 3;
        plane.normal[axis] = side(1, u) * side(2, w) - side(1, w) * side(2, u);
        plane.at += Wide(plane.normal[axis]) * t[0][axis];
    }
    return plane;
}

/// The voxel along the line through the centre of voxel `v` in which the plane crosses it.
int64_t crossed_voxel(const Plane& plane, const RowAxes& axes, const glm::ivec3& v) {
    const Wide rest = plane.at -
                      Wide(plane.normal[axes.u]) * (v[axes.u] * kUnitsPerVoxel + kCenter) -
                      Wide(plane.normal[axes.w]) * (v[axes.w] * kUnitsPerVoxel + kCenter);
    const Wide per_voxel = Wide(plane.normal[axes.along]) * kUnitsPerVoxel;
    const Wide voxel = per_voxel < 0 ? floor_of(-rest, -per_voxel) : floor_of(rest, per_voxel);
    return int64_t(voxel);
}

}  // namespace

std::vector<glm::ivec3> exact_thin(const TriangleOnLattice& t, const glm::ivec3& region) {
    std::vector<glm::ivec3> voxels;
    const Plane plane = plane_of(t);
    for (int along = 0; along < 3; ++along) {
        const RowAxes axes{along, (along + 1) % 3, (along + 2) % 3};
        const auto [low, high] = std::minmax({t[0][axes.w], t[1][axes.w], t[2][axes.w]});
        if (plane.normal[along] == 0) continue;
        const int first = std::max(0, int(floor_of<int64_t>(low, kUnitsPerVoxel)));
        const int last = std::min(region[axes.w] - 1, int(floor_of<int64_t>(high, kUnitsPerVoxel)));
        glm::ivec3 v(0);
        for (v[axes.w] = first; v[axes.w] <= last; ++v[axes.w]) {
            const VoxelRow row = lines_of_row(t, axes, v[axes.w] * kUnitsPerVoxel + kCenter);
            if (row.first > row.last) continue;
            const int end = int(std::min<int64_t>(row.last, region[axes.u] - 1));
            for (v[axes.u] = int(std::max<int64_t>(row.first, 0)); v[axes.u] <= end; ++v[axes.u]) {
                const int64_t crossed = crossed_voxel(plane, axes, v);
                if (crossed < 0 || crossed >= region[along]) continue;
                v[along] = int(crossed);
                voxels.push_back(v);
            }
        }
    }
    return voxels;
}

}  // namespace voxelume
