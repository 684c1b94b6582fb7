// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/mesh/triangle_overlap.hpp"

#include <gmpxx.h>

#include <algorithm>

namespace voxelume::oracle {
namespace {

__extension__ typedef __int128 Int128;
struct Axis {
    Int128 x, y, z;
};

Axis to_axis(const glm::ivec3& v) {
    return {v.x, v.y, v.z};
}

Axis cross(const Axis& a, const Axis& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Int128 dot(const Axis& a, const glm::ivec3& p) {
    return a.x * p.x + a.y * p.y + a.z * p.z;
}

bool separates(const Axis& axis, const glm::ivec3& v, int margin, const LatticeCorners& triangle) {
    Int128 cube_low = 0, cube_high = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 far(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::ivec3 p = (v + far) * 4096 + (2 * far - 1) * margin;
        const Int128 at = dot(axis, p);
        cube_low = corner ? std::min(cube_low, at) : at;
        cube_high = corner ? std::max(cube_high, at) : at;
    }
    const Int128 a = dot(axis, triangle[0]), b = dot(axis, triangle[1]), c = dot(axis, triangle[2]);
    return std::max({a, b, c}) < cube_low || std::min({a, b, c}) > cube_high;
}

using Rational = mpq_class;
using Point = std::array<Rational, 3>;

Point to_point(const glm::ivec3& p) {
    return {Rational(p.x), Rational(p.y), Rational(p.z)};
}

/// The point p moved by (e, e², e³).
Point moved(Point p) {
    Rational e(1);
    mpq_div_2exp(e.get_mpq_t(), e.get_mpq_t(), 80);
    p[0] += e;
    p[1] += e * e;
    p[2] += e * e * e;
    return p;
}

Rational turn(const Point& a, const Point& b, const Point& p, int u, int w) {
    return (b[u] - a[u]) * (p[w] - a[w]) - (b[w] - a[w]) * (p[u] - a[u]);
}

/// True if the line through `p` along `axis` passes the triangle's bounding box; most lines don't.
bool passes_box(const glm::ivec3& p, int axis, const LatticeCorners& t) {
    for (int a = 0; a < 3; ++a)
        if (a != axis && (p[a] < std::min({t[0][a], t[1][a], t[2][a]}) ||
                          p[a] > std::max({t[0][a], t[1][a], t[2][a]})))
            return false;
    return true;
}

/// Returns 0 if the line through p along `axis` doesn't cross the triangle; else the sign of the
/// crossing, and its coordinate in `at`.
int line_crossing(const Point& p, int axis, const LatticeCorners& triangle, Rational& at) {
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    const Point a = to_point(triangle[0]), b = to_point(triangle[1]), c = to_point(triangle[2]);
    const Rational area = turn(a, b, c, u, w);
    if (area == 0) return 0;
    const Rational wa = turn(b, c, p, u, w) / area, wb = turn(c, a, p, u, w) / area,
                   wc = turn(a, b, p, u, w) / area;
    if (wa <= 0 || wb <= 0 || wc <= 0) return 0;
    at = wa * a[axis] + wb * b[axis] + wc * c[axis];
    return area > 0 ? 1 : -1;
}

/// The coordinate at which the line through p along `axis` crosses the triangle's plane, which is
/// not parallel to the line.
Rational plane_crossing(const Point& p, int axis, const LatticeCorners& triangle) {
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    const Point a = to_point(triangle[0]), b = to_point(triangle[1]), c = to_point(triangle[2]);
    const Rational area = turn(a, b, c, u, w);
    return (turn(b, c, p, u, w) * a[axis] + turn(c, a, p, u, w) * b[axis] +
            turn(a, b, p, u, w) * c[axis]) /
           area;
}

}  // namespace

bool cube_meets_triangle(const glm::ivec3& v, const LatticeCorners& triangle, int margin) {
    const Axis unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const Axis e0 = to_axis(triangle[1] - triangle[0]), e1 = to_axis(triangle[2] - triangle[1]),
               e2 = to_axis(triangle[0] - triangle[2]);
    if (separates(cross(e0, e1), v, margin, triangle)) return false;
    for (const Axis& u : unit) {
        if (separates(u, v, margin, triangle)) return false;
        for (const Axis& e : {e0, e1, e2})
            if (separates(cross(u, e), v, margin, triangle)) return false;
    }
    return true;
}

bool crosshair_meets_triangle(const glm::ivec3& v, const LatticeCorners& triangle) {
    const Point center = to_point(v * 4096 + 2048);
    for (int axis = 0; axis < 3; ++axis) {
        if (!passes_box(v * 4096 + 2048, axis, triangle)) continue;
        Rational at;
        if (line_crossing(moved(center), axis, triangle, at) == 0) continue;
        // The shift only decides which triangle owns an edge; the coordinate is that on the
        // unshifted line.
        at = plane_crossing(center, axis, triangle);
        if (at >= v[axis] * 4096 && at < (v[axis] + 1) * 4096) return true;
    }
    return false;
}

int winding_number(const glm::ivec3& point, const std::vector<LatticeCorners>& mesh) {
    const Point p = moved(to_point(point));
    int winding = 0;
    for (const LatticeCorners& triangle : mesh) {
        if (!passes_box(point, 2, triangle)) continue;
        Rational at;
        const int sign = line_crossing(p, 2, triangle, at);
        if (sign != 0 && at > p[2]) winding += sign;
    }
    return winding;
}

}  // namespace voxelume::oracle
