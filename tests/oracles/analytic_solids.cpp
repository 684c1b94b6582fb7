// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/analytic_solids.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace voxelume::oracle {
namespace {

using Real = long double;

/// The distance to a convex polygon in the plane, corners counter-clockwise; positive outside.
Real polygon_distance(const std::vector<std::pair<Real, Real>>& corners, Real x, Real y) {
    Real nearest = INFINITY;
    bool inside = true;
    for (size_t i = 0; i < corners.size(); ++i) {
        const auto [ax, ay] = corners[i];
        const auto [bx, by] = corners[(i + 1) % corners.size()];
        const Real ex = bx - ax, ey = by - ay, squared = ex * ex + ey * ey;
        if (squared == 0) continue;
        const Real s = std::clamp(((x - ax) * ex + (y - ay) * ey) / squared, Real(0), Real(1));
        nearest = std::min(nearest, std::hypot(x - ax - s * ex, y - ay - s * ey));
        inside &= ex * (y - ay) - ey * (x - ax) >= 0;
    }
    return inside ? -nearest : nearest;
}

/// The distance to a solid of revolution. Its profile is mirrored at the axis, and inner edges
/// don't count.
Real revolved_distance(Real bottom, Real top, Real half_height, const Vector& p) {
    return polygon_distance(
        {{-bottom, -half_height}, {bottom, -half_height}, {top, half_height}, {-top, half_height}},
        std::hypot(p.x, p.z), p.y);
}

Real box_distance(const Vector& half, const Vector& p) {
    Real outside = 0, inside = -INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
        const Real beyond = std::abs(p[axis]) - half[axis];
        outside += beyond > 0 ? beyond * beyond : 0;
        inside = std::max(inside, beyond);
    }
    return inside > 0 ? std::sqrt(outside) : inside;
}

/// The distance to an ellipsoid. Bisection finds the multiplier of the foot point, in the variable
/// u = t + r_min², on (0, ...).
Real ellipsoid_distance(const Vector& r, const Vector& point) {
    const Vector p = glm::abs(point);
    const int k = r.x <= r.y && r.x <= r.z ? 0 : r.y <= r.z ? 1 : 2;
    const Real base = r[k] * r[k];
    const auto excess = [&](Real u) {
        Real sum = -1;
        for (int i = 0; i < 3; ++i) {
            const Real s = r[i] * p[i] / (u + (r[i] * r[i] - base));
            sum += s * s;
        }
        return sum;
    };
    const Real longest = std::max({r.x, r.y, r.z});
    Real low = 0, high = base + longest * glm::length(p) + longest * longest;
    for (int i = 0; i < 200; ++i) {
        const Real middle = (low + high) / 2;
        (excess(middle) > 0 ? low : high) = middle;
    }
    Vector foot(0);
    Real rest = 1;
    for (int i = 0; i < 3; ++i) {
        if (i == k) continue;
        foot[i] = r[i] * r[i] * p[i] / (high + (r[i] * r[i] - base));
        rest -= foot[i] / r[i] * (foot[i] / r[i]);
    }
    foot[k] = high > base / 2 ? base * p[k] / high : r[k] * std::sqrt(std::max(rest, Real(0)));
    const bool inside = excess(base) < 0;
    return inside ? -glm::length(p - foot) : glm::length(p - foot);
}

Real shape_distance(const Solid& s, const Vector& p) {
    switch (s.kind) {
        case SolidKind::sphere:
            return glm::length(p) - Real(s.radius);
        case SolidKind::ellipsoid:
            return ellipsoid_distance(Vector(s.radii), p);
        case SolidKind::box:
            return box_distance(Vector(s.size) / Real(2), p);
        case SolidKind::cylinder:
            return revolved_distance(s.radius, s.radius, s.height / 2, p);
        case SolidKind::cone:
            return revolved_distance(s.radius, s.top_radius, s.height / 2, p);
        case SolidKind::torus: {
            const Real across = std::hypot(p.x, p.z);
            const Vector on_ring = across > 0 ? Vector(p.x, 0, p.z) * (Real(s.radius) / across)
                                              : Vector(s.radius, 0, 0);
            return glm::length(p - on_ring) - Real(s.tube);
        }
        case SolidKind::capsule: {
            const Real half = Real(s.height) / 2;
            return glm::length(p - Vector(0, std::clamp(p.y, -half, half), 0)) - Real(s.radius);
        }
        default:
            return std::abs(p.y) - Real(s.thickness) / 2;
    }
}

/// The smallest singular value, as the square root of the smallest eigenvalue of mT m, by the
/// trigonometric solution of the characteristic cubic.
Real smallest_scale(const glm::mat<3, 3, Real>& m) {
    const glm::mat<3, 3, Real> g = glm::transpose(m) * m;
    const Real mean = (g[0][0] + g[1][1] + g[2][2]) / 3;
    glm::mat<3, 3, Real> b = g;
    for (int i = 0; i < 3; ++i) b[i][i] -= mean;
    Real squared = 0;
    for (int i = 0; i < 3; ++i) squared += glm::dot(b[i], b[i]);
    const Real p = std::sqrt(squared / 6);
    if (p < mean * 1e-15L) return std::sqrt(mean);
    const Real half_determinant =
        std::clamp(glm::determinant(b) / (2 * p * p * p), Real(-1), Real(1));
    constexpr Real kThird = 2.0943951023931954923084289221863L;  // of a full turn
    return std::sqrt(
        std::max(Real(0), mean + 2 * p * std::cos(std::acos(half_determinant) / 3 + kThird)));
}

}  // namespace

AnalyticSolid::AnalyticSolid(const Solid& solid, const glm::dmat4& frame_from_solid)
    : root_(make_node(solid, glm::mat<4, 4, Real>(frame_from_solid))) {}

AnalyticSolid::Node AnalyticSolid::make_node(const Solid& solid,
                                             const glm::mat<4, 4, Real>& frame_from_parent) {
    const glm::mat<4, 4, Real> frame_from_local =
        frame_from_parent * glm::mat<4, 4, Real>(solid.parent_from_solid);
    Node node;
    node.solid = solid;
    node.solid.parts.clear();
    node.local_from_frame = glm::inverse(frame_from_local);
    node.scale = smallest_scale(glm::mat<3, 3, Real>(frame_from_local));
    for (const Solid& part : solid.parts) node.parts.push_back(make_node(part, frame_from_local));
    return node;
}

long double AnalyticSolid::node_distance(const Node& node, const Vector& point) {
    if (node.parts.empty())
        return node.scale * shape_distance(node.solid, Vector(node.local_from_frame *
                                                              glm::vec<4, Real>(point, 1)));
    Real d = node_distance(node.parts[0], point);
    for (size_t i = 1; i < node.parts.size(); ++i) {
        const Real part = node_distance(node.parts[i], point);
        if (node.solid.kind == SolidKind::union_of)
            d = std::min(d, part);
        else if (node.solid.kind == SolidKind::intersection_of)
            d = std::max(d, part);
        else
            d = std::max(d, -part);
    }
    return d;
}

long double AnalyticSolid::distance(const Vector& point) const {
    return node_distance(root_, point);
}

AnalyticSolid::Crossing AnalyticSolid::first_crossing(const Vector& origin, const Vector& direction,
                                                      long double first, long double last,
                                                      long double uncertainty) const {
    Crossing found;
    search(origin, direction, first, last, uncertainty, found);
    found.is_certain =
        found.graze < 0 || (found.is_hit && found.t - found.graze < 1000 * uncertainty);
    return found;
}

/// Searches an interval for crossings. An interval has none if its middle is farther from the
/// surface than its ends are from the middle; its ends decide if it is shorter than `uncertainty`.
void AnalyticSolid::search(const Vector& origin, const Vector& direction, long double first,
                           long double last, long double uncertainty, Crossing& found) const {
    if (found.is_hit) return;
    const auto at = [&](Real t) { return distance(origin + direction * t); };
    const Real half = (last - first) / 2;
    if (std::abs(at(first + half)) > half) return;
    if (last - first > uncertainty) {
        search(origin, direction, first, first + half, uncertainty, found);
        search(origin, direction, first + half, last, uncertainty, found);
        return;
    }
    const bool before = at(first) <= 0;
    if (before == (at(last) <= 0)) {
        found.graze = last;
        return;
    }
    for (int i = 0; i < 80; ++i) {
        const Real middle = (first + last) / 2;
        ((at(middle) <= 0) == before ? first : last) = middle;
    }
    found.t = last;
    found.is_hit = true;
}

}  // namespace voxelume::oracle
