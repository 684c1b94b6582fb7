// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/cell_walk.hpp"

#include <cmath>
#include <cstdint>

namespace voxelume::oracle {
namespace {

__extension__ using Wide = __int128;

/// t = numerator / denominator of the next crossing on one axis; denominator 0 means never.
struct Time {
    Wide numerator = 0, denominator = 0;
};

bool before(const Time& a, const Time& b) {
    if (a.denominator == 0) return false;
    if (b.denominator == 0) return true;
    return a.numerator * b.denominator < b.numerator * a.denominator;
}

int64_t floor_divide(int64_t a, int64_t b) {
    return a / b - (a % b != 0 && (a < 0) != (b < 0));
}

double value_of(const Time& time, int fraction_bits) {
    if (time.denominator == 0) return 0;
    return double(time.numerator) / double(time.denominator) * std::ldexp(1.0, 22 - fraction_bits);
}

/// Calls `visit(cell, axis, time in, time out)` for each cell until it returns false.
template <class Visit>
void walk(const glm::dvec3& o, const glm::dvec3& d, const glm::ivec3& size, int fraction_bits,
          const Visit& visit) {
    const int64_t unit = int64_t(1) << fraction_bits;
    int64_t origin[3], direction[3], cell[3];
    for (int a = 0; a < 3; ++a) {
        origin[a] = std::llround(std::ldexp(o[a], fraction_bits));
        direction[a] = std::llround(std::ldexp(d[a], 22));
        // floor for a ray that moves up or doesn't move, ceil - 1 for a ray that moves down
        cell[a] =
            direction[a] >= 0 ? floor_divide(origin[a], unit) : -floor_divide(-origin[a], unit) - 1;
    }
    int entered_across = 3;
    for (Time now; true;) {
        for (int a = 0; a < 3; ++a)
            if (cell[a] < 0 || cell[a] >= size[a]) return;
        const glm::ivec3 here{int(cell[0]), int(cell[1]), int(cell[2])};
        Time next;
        int axis = 0;
        for (int a = 0; a < 3; ++a) {
            if (direction[a] == 0) continue;
            const int64_t plane = (cell[a] + (direction[a] > 0 ? 1 : 0)) * unit;
            const Time time = {direction[a] > 0 ? plane - origin[a] : origin[a] - plane,
                               direction[a] > 0 ? direction[a] : -direction[a]};
            if (next.denominator != 0 && !before(time, next)) continue;
            next = time;
            axis = a;
        }
        if (!visit(here, entered_across, value_of(now, fraction_bits),
                   value_of(next, fraction_bits)))
            return;
        now = next;
        cell[axis] += direction[axis] > 0 ? 1 : -1;
        entered_across = axis;
    }
}

}  // namespace

FirstHit first_hit(const glm::dvec3& o, const glm::dvec3& d, const glm::ivec3& size,
                   int fraction_bits, const VoxelSet& voxels) {
    FirstHit result;
    walk(o, d, size, fraction_bits, [&](const glm::ivec3& cell, int axis, double t_in, double) {
        if (!voxels.contains(cell)) return true;
        result = {true, cell, axis, t_in};
        return false;
    });
    return result;
}

std::vector<CrossedCell> cells_crossed(const glm::dvec3& o, const glm::dvec3& d,
                                       const glm::ivec3& size, int fraction_bits) {
    std::vector<CrossedCell> cells;
    walk(o, d, size, fraction_bits, [&](const glm::ivec3& cell, int, double t_in, double t_out) {
        cells.push_back({cell, t_in, t_out});
        return true;
    });
    return cells;
}

}  // namespace voxelume::oracle
