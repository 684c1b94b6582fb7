#include "tests/oracles/cell_walk.hpp"

#include <cmath>
#include <cstdint>

namespace oracle {
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

}  // namespace

FirstHit first_hit(const glm::dvec3& o, const glm::dvec3& d, const glm::ivec3& size,
                   int fraction_bits, const VoxelSet& voxels) {
    const int64_t unit = int64_t(1) << fraction_bits;
    int64_t origin[3], direction[3], cell[3];
    for (int a = 0; a < 3; ++a) {
        origin[a] = std::llround(std::ldexp(o[a], fraction_bits));
        direction[a] = std::llround(std::ldexp(d[a], 22));
        // floor for a ray that moves up or not at all, ceil - 1 for one that moves down
        cell[a] =
            direction[a] >= 0 ? floor_divide(origin[a], unit) : -floor_divide(-origin[a], unit) - 1;
    }
    FirstHit result;
    for (Time now; true;) {
        for (int a = 0; a < 3; ++a)
            if (cell[a] < 0 || cell[a] >= size[a]) return {};
        const glm::ivec3 here{int(cell[0]), int(cell[1]), int(cell[2])};
        if (voxels.contains(here)) {
            result.hit = true;
            result.cell = here;
            if (now.denominator != 0)
                result.t = double(now.numerator) / double(now.denominator) *
                           std::ldexp(1.0, 22 - fraction_bits);
            return result;
        }
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
        now = next;
        cell[axis] += direction[axis] > 0 ? 1 : -1;
        result.axis = axis;
    }
}

}  // namespace oracle
