// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/exact/exact_walk.hpp"

#include <algorithm>
#include <bit>

#include "kernels/shared/stress.h"

namespace voxelume {
namespace {

/// A ray with some axes reversed so that no direction is negative: distances, cells and planes then
/// grow along it. A cell on a reversed axis is the complement of the original cell.
struct Turned {
    int64_t origin[3], direction[3];
    int32_t cell[3], complement[3];  // complement is 0, or -1 where the axis is reversed
    int32_t left[3];                 // number of cells up to the grid's side
    float float_origin[3], inverse[3];
};

Turned turn(const FixedGrid& grid, const FixedRay& ray) {
    Turned r;
    for (int a = 0; a < 3; ++a) {
        const bool down = ray.direction[a] < 0;
        r.origin[a] = down ? -ray.origin[a] : ray.origin[a];
        r.direction[a] = down ? -ray.direction[a] : ray.direction[a];
        r.complement[a] = down ? -1 : 0;
        r.cell[a] = int32_t(r.origin[a] >> grid.fraction_bits);
        const int32_t cell = r.cell[a] ^ r.complement[a];
        r.left[a] = cell < 0 || cell >= grid.size[a] ? -1 : down ? cell : grid.size[a] - 1 - cell;
        // Both are exact: the origin has at most 24 bits.
        r.float_origin[a] = float(ray.origin[a]) / float(grid.unit());
        r.inverse[a] = 1.0f / (float(ray.direction[a]) / float(1 << 22));
    }
    return r;
}

glm::ivec3 cell_of(const Turned& r) {
    return {r.cell[0] ^ r.complement[0], r.cell[1] ^ r.complement[1], r.cell[2] ^ r.complement[2]};
}

/// The t at which the ray crosses the plane before its present cell.
float crossing_time(const Turned& r, int axis) {
    const int32_t plane = r.complement[axis] ? -r.cell[axis] : r.cell[axis];
    return (float(plane) - r.float_origin[axis]) * r.inverse[axis];
}

bool is_inside(const Turned& r) {
    return (r.left[0] | r.left[1] | r.left[2]) >= 0;
}

/// Walks from cell to cell. `visit(turned, axis, t)` returns whether to go on.
///
/// The comparison t_x <= t_y is A_x D_y <= A_y D_x, where A is the distance to the next plane and D
/// the direction. The differences of these products have 24 + 22 + 1 bits and change by multiples
/// of D at each step.
template <class Visit>
void walk_cells(const FixedGrid& grid, Turned& r, const Visit& visit) {
    if (!is_inside(r) || !visit(3, 0.0f)) return;
    int64_t a[3], step[3];
    for (int i = 0; i < 3; ++i) {
        a[i] = (int64_t(r.cell[i]) + 1) * grid.unit() - r.origin[i];
        step[i] = r.direction[i] * grid.unit();
    }
    int64_t xy = a[0] * r.direction[1] - a[1] * r.direction[0];
    int64_t xz = a[0] * r.direction[2] - a[2] * r.direction[0];
    int64_t yz = a[1] * r.direction[2] - a[2] * r.direction[1];
    while (true) {
        const int64_t x = -int64_t((xy <= 0) & (xz <= 0));
        const int64_t y = ~x & -int64_t(yz <= 0);
        const int64_t z = ~(x | y);
        xy += (step[1] & x) - (step[0] & y);
        xz += (step[2] & x) - (step[0] & z);
        yz += (step[2] & y) - (step[1] & z);
        const int axis = int((y & 1) | (z & 2));
        ++r.cell[axis];
        if (r.left[axis]-- == 0 || !visit(axis, crossing_time(r, axis))) return;
    }
}

/// The turned cell at a distance along an axis: `whole`, plus a fraction if `parts` is true. On a
/// plane it is the cell behind the plane if `crossed`, else the one before it.
int32_t cell_at(const FixedGrid& grid, int64_t whole, bool parts, bool crossed) {
    const bool on_plane = !parts && (whole & (grid.unit() - 1)) == 0;
    return int32_t(whole >> grid.fraction_bits) - (on_plane && !crossed);
}

/// Leaves the aligned block of 1 << log2 cells around the present cell. Returns the axis.
int leave_block(const FixedGrid& grid, Turned& r, int log2) {
    const int32_t edge = 1 << log2;
    int64_t distance[3];
    for (int a = 0; a < 3; ++a)  // ~cell has the same blocks as cell
        distance[a] = int64_t((r.cell[a] & -edge) + edge) * grid.unit() - r.origin[a];
    const auto not_later = [&](int a, int b) {  // t_a <= t_b; an axis with D = 0 is never left
        return distance[a] * r.direction[b] <= distance[b] * r.direction[a];
    };
    const int exit = not_later(0, 1) && not_later(0, 2) ? 0 : not_later(1, 2) ? 1 : 2;
    for (int a = 0; a < 3; ++a) {
        int32_t next = (r.cell[a] & -edge) + edge;
        if (a != exit) {
            if (r.direction[a] == 0) continue;
            const int64_t way = distance[exit] * r.direction[a];
            next = cell_at(grid, r.origin[a] + way / r.direction[exit],
                           way % r.direction[exit] != 0, a < exit);
        }
        r.left[a] -= next - r.cell[a];
        r.cell[a] = next;
    }
    return exit;
}

template <class Visit>
void walk(const FixedGrid& grid, Turned& r, Steps steps, const Visit& visit) {
    if (steps == Steps::cells) return walk_cells(grid, r, visit);
    int axis = 3;
    float t = 0;
    while (is_inside(r) && visit(axis, t)) {
        axis = leave_block(grid, r, block_log2(cell_of(r)));
        t = crossing_time(r, axis);
    }
}

uint32_t mixed(uint32_t hash, const glm::ivec3& cell, int axis, float t) {
    const uint32_t cell_hash = uint32_t(cell.x) * VXL_HASH_X + uint32_t(cell.y) * VXL_HASH_Y +
                               uint32_t(cell.z) * VXL_HASH_Z + uint32_t(axis);
    return ((hash ^ std::bit_cast<uint32_t>(t)) + cell_hash) * VXL_HASH_FACTOR;
}

}  // namespace

FixedGrid fixed_grid(const glm::ivec3& size) {
    const unsigned longest = unsigned(std::max({size.x, size.y, size.z}));
    return {size, 24 - int(std::bit_width(longest))};
}

int block_log2(const glm::ivec3& cell) {
    const uint32_t mix = (uint32_t(cell.x >> 3) * VXL_HASH_X + uint32_t(cell.y >> 3) * VXL_HASH_Y +
                          uint32_t(cell.z >> 3) * VXL_HASH_Z) *
                         VXL_HASH_FACTOR;
    return std::max(0, int(mix >> 28) - 9);
}

WalkDigest exact_digest(const FixedGrid& grid, const FixedRay& ray, Steps steps, uint32_t maximum) {
    Turned r = turn(grid, ray);
    WalkDigest digest;
    walk(grid, r, steps, [&](int axis, float t) {
        digest.hash = mixed(digest.hash, cell_of(r), axis, t);
        return ++digest.cells < maximum;
    });
    return digest;
}

std::vector<EnteredCell> exact_cells(const FixedGrid& grid, const FixedRay& ray, Steps steps,
                                     uint32_t maximum) {
    Turned r = turn(grid, ray);
    std::vector<EnteredCell> cells;
    walk(grid, r, steps, [&](int axis, float t) {
        cells.push_back({cell_of(r), axis, t});
        return cells.size() < maximum;
    });
    return cells;
}

bool exact_first_hit(const FixedGrid& grid, const FixedRay& ray, const VoxelBits& voxels,
                     EnteredCell& hit) {
    Turned r = turn(grid, ray);
    bool found = false;
    walk_cells(grid, r, [&](int axis, float t) {
        found = voxels.is_set(cell_of(r));
        if (found) hit = {cell_of(r), axis, t};
        return !found;
    });
    return found;
}

}  // namespace voxelume
