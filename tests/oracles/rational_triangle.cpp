// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/rational_triangle.hpp"

namespace voxelume::oracle {
namespace {

RationalPoint minus(const RationalPoint& a, const RationalPoint& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

RationalPoint cross(const RationalPoint& a, const RationalPoint& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

mpq_class dot(const RationalPoint& a, const RationalPoint& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

std::optional<mpq_class> ray_meets_triangle(const RationalPoint& o, const RationalPoint& d,
                                            const std::array<RationalPoint, 3>& triangle) {
    const RationalPoint n = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]));
    const mpq_class facing = dot(n, d);
    if (facing == 0) return {};
    const mpq_class t = dot(n, minus(triangle[0], o)) / facing;
    if (t < 0) return {};
    // The ray's line spans three volumes with the edges. Where it passes through the triangle all
    // have one sign; on an edge one is 0.
    bool any_positive = false, any_negative = false;
    for (size_t i = 0; i < 3; ++i) {
        const mpq_class volume =
            dot(d, cross(minus(triangle[i], o), minus(triangle[(i + 1) % 3], o)));
        any_positive |= volume > 0;
        any_negative |= volume < 0;
    }
    if (any_positive && any_negative) return {};
    return t;
}

}  // namespace voxelume::oracle
