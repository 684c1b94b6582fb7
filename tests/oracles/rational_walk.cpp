// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/rational_walk.hpp"

namespace voxelume::oracle {
namespace {

mpz_class floor_of(const mpq_class& q) {
    mpz_class result;
    mpz_fdiv_q(result.get_mpz_t(), q.get_num_mpz_t(), q.get_den_mpz_t());
    return result;
}

/// The cell along one axis that contains the ray at, or just after, the coordinate `p`.
long cell_being_entered(const mpq_class& p, const mpq_class& d) {
    const mpz_class low = floor_of(p);
    return low.get_si() - (d < 0 && mpq_class(low) == p);
}

/// A point where the walk crosses a plane.
struct Next {
    mpq_class t;
    int axis = 3;
};

Next next_crossing(const Rational3& o, const Rational3& d, const long (&cell)[3]) {
    Next next;
    for (int a = 0; a < 3; ++a) {
        if (d[size_t(a)] == 0) continue;
        const mpq_class t = (cell[a] + (d[size_t(a)] > 0) - o[size_t(a)]) / d[size_t(a)];
        if (next.axis == 3 || t < next.t) next = {t, a};
    }
    return next;
}

bool is_inside(const long (&cell)[3], const glm::ivec3& size) {
    for (int a = 0; a < 3; ++a)
        if (cell[a] < 0 || cell[a] >= size[a]) return false;
    return true;
}

/// Sets `entry` to the t at which the ray has come between the planes of every axis. Returns false
/// if it never does.
bool find_entry(const Rational3& o, const Rational3& d, const glm::ivec3& size, mpq_class& entry) {
    mpq_class exit;
    bool ends = false;
    for (int a = 0; a < 3; ++a) {
        const size_t i = size_t(a);
        if (d[i] == 0) {
            if (o[i] < 0 || o[i] >= size[a]) return false;
            continue;
        }
        mpq_class in = -o[i] / d[i], out = (size[a] - o[i]) / d[i];
        if (d[i] < 0) std::swap(in, out);
        if (in > entry) entry = in;
        if (!ends || out < exit) exit = out;
        ends = true;
    }
    return !ends || entry <= exit;
}

}  // namespace

Rational3 rationals(double x, double y, double z) {
    return {mpq_class(x), mpq_class(y), mpq_class(z)};
}

std::vector<RationalCell> rational_walk(const Rational3& o, const Rational3& d,
                                        const glm::ivec3& size, size_t maximum) {
    std::vector<RationalCell> cells;
    mpq_class entry = 0;
    if (!find_entry(o, d, size, entry)) return cells;
    // The walk starts in the infinite lattice just before the grid. So the order of crossings at
    // one t decides at the grid's sides as it does elsewhere.
    long cell[3];
    for (int a = 0; a < 3; ++a) {
        const size_t i = size_t(a);
        const mpq_class p = o[i] + d[i] * entry;
        cell[a] = cell_being_entered(p, d[i]);
        const bool crosses_now = entry > 0 && d[i] != 0 && mpq_class(floor_of(p)) == p;
        if (crosses_now) cell[a] -= d[i] > 0 ? 1 : -1;
    }
    int axis = 3;
    bool was_inside = false;
    while (cells.size() < maximum) {
        if (is_inside(cell, size)) {
            cells.push_back({{int(cell[0]), int(cell[1]), int(cell[2])}, axis});
            was_inside = true;
        } else if (was_inside) {
            break;
        }
        const Next next = next_crossing(o, d, cell);
        if (next.axis == 3 || (!was_inside && next.t > entry)) break;
        cell[next.axis] += d[size_t(next.axis)] > 0 ? 1 : -1;
        axis = next.axis;
    }
    return cells;
}

}  // namespace voxelume::oracle
