// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/exact/exact_snap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelume {
namespace {

/// The interval of t in which a ray is between all planes of a grid. The grid is wider by `margin`
/// on every side.
struct Passage {
    double first = 0, last = std::numeric_limits<double>::infinity();
};

/// The passage of a ray. Doubles lose 2^-53 of the way, where floats may lose 2^-20.
Passage passage(const FixedGrid& grid, const glm::vec3& o, const std::array<int64_t, 3>& direction,
                double margin) {
    Passage p;
    for (int a = 0; a < 3; ++a) {
        const double d = std::ldexp(double(direction[size_t(a)]), -22);
        const double low = -margin - double(o[a]), high = grid.size[a] + margin - double(o[a]);
        if (low > high || (d == 0 && (low > 0 || high < 0))) p.last = -1;
        if (d == 0) continue;
        p.first = std::max(p.first, std::min(low / d, high / d));
        p.last = std::min(p.last, std::max(low / d, high / d));
    }
    return p;
}

bool passes(const Passage& p) {
    return p.first <= p.last;
}

}  // namespace

std::array<int64_t, 3> exact_direction(const glm::vec3& direction) {
    float largest = 0;
    for (int a = 0; a < 3; ++a) largest = std::max(largest, std::abs(direction[a]));
    int exponent = 0;
    std::frexp(largest, &exponent);
    std::array<int64_t, 3> d;
    for (int a = 0; a < 3; ++a)
        d[size_t(a)] = int64_t(std::nearbyint(std::ldexp(double(direction[a]), 22 - exponent)));
    return d;
}

double snap_bound(const FixedGrid& grid, const FloatRay& ray) {
    double way = std::max({grid.size.x, grid.size.y, grid.size.z});
    for (int a = 0; a < 3; ++a) way = std::max(way, double(std::abs(ray.origin[a])));
    return std::ldexp(1.0, -grid.fraction_bits) + std::ldexp(way, 4 - 24);
}

std::string snap_fault(const FixedGrid& grid, const FloatRay& ray, const FixedRay* snapped) {
    const std::array<int64_t, 3> direction = exact_direction(ray.direction);
    const double bound = snap_bound(grid, ray);
    if (snapped == nullptr)
        return passes(passage(grid, ray.origin, direction, -bound)) ? "idle, though it comes in"
                                                                    : "";
    if (!passes(passage(grid, ray.origin, direction, bound))) return "not idle, though it passes";
    if (snapped->direction != direction)
        return fmt::format("direction ({},{},{}), exact is ({},{},{})", snapped->direction[0],
                           snapped->direction[1], snapped->direction[2], direction[0], direction[1],
                           direction[2]);
    const double t = passage(grid, ray.origin, direction, 0).first;
    for (int a = 0; a < 3; ++a) {
        const int64_t coordinate = snapped->origin[size_t(a)];
        if (coordinate < 0 || coordinate > grid.size[a] * grid.unit())
            return fmt::format("begins outside of the grid, at {} / 2^{}", coordinate,
                               grid.fraction_bits);
        const double exact =
            double(ray.origin[a]) + std::ldexp(double(direction[size_t(a)]), -22) * t;
        const double off = std::ldexp(double(coordinate), -grid.fraction_bits) - exact;
        if (std::abs(off) > 2 * bound)
            return fmt::format("begins {} voxels off along {}, more than {}", off, "xyz"[a],
                               2 * bound);
    }
    return "";
}

}  // namespace voxelume
