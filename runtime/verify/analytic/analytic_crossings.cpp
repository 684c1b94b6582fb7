// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/analytic/analytic_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <stdexcept>

#include "runtime/verify/analytic/polynomial_roots.hpp"

namespace voxelume::oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The numbers of a solid's faces: 0 is the curved part. The plane across an axis is 1 + 2 * axis,
/// plus 1 on the positive side.
constexpr int kCurved = 0;

/// The part of a line inside a convex solid; empty if `first >= last`.
struct Span {
    double first = -kInfinity, last = kInfinity;
    int first_face = kCurved, last_face = kCurved;
};

constexpr Span kNowhere{kInfinity, -kInfinity};

Span intersection(const Span& a, const Span& b) {
    Span both = a;
    if (b.first > a.first) both.first = b.first, both.first_face = b.first_face;
    if (b.last < a.last) both.last = b.last, both.last_face = b.last_face;
    return both;
}

/// The part of a line in the convex hull of two parts.
Span hull(const Span& a, const Span& b) {
    if (a.first >= a.last) return b;
    if (b.first >= b.last) return a;
    return {std::min(a.first, b.first), std::max(a.last, b.last)};
}

/// The part of a line where |coordinate| <= half along one axis.
Span between_planes(const Line& line, int axis, double half) {
    const double o = line.origin[axis], d = line.direction[axis];
    const int low = 1 + 2 * axis, high = low + 1;
    if (d == 0) return std::abs(o) < half ? Span{} : kNowhere;
    const double to_low = (-half - o) / d, to_high = (half - o) / d;
    return d > 0 ? Span{to_low, to_high, low, high} : Span{to_high, to_low, high, low};
}

/// The part of a line inside a sphere around the origin. It is computed from the distance between
/// the centre and the line, not from a difference of two squares, so that far lines stay accurate.
Span in_sphere(const Line& line, double radius) {
    const double squared = glm::dot(line.direction, line.direction);
    if (squared == 0) return kNowhere;
    const double middle = -glm::dot(line.origin, line.direction) / squared;
    const glm::dvec3 nearest = line.origin + line.direction * middle;
    const double rest = radius * radius - glm::dot(nearest, nearest);
    if (rest <= 0) return kNowhere;
    const double half = std::sqrt(rest / squared);
    return {middle - half, middle + half};
}

Span in_endless_cylinder(Line line, double radius) {
    line.origin.y = line.direction.y = 0;
    if (line.direction == glm::dvec3(0))
        return glm::length(line.origin) < radius ? Span{} : kNowhere;
    return in_sphere(line, radius);
}

Line shifted(Line line, double y) {
    line.origin.y -= y;
    return line;
}

/// A cone's radius is that of its middle and grows by a slope along Y.
double middle_radius(const Solid& cone) {
    return (cone.radius + cone.top_radius) / 2;
}
double slope(const Solid& cone) {
    return (cone.top_radius - cone.radius) / cone.height;
}

/// The part of a line inside a cone. Beyond its tip is a second cone, which the planes cut off.
Span in_cone(const Solid& cone, const Line& line) {
    using Real = long double;
    const Span planes = between_planes(line, 1, cone.height / 2);
    const Real k = slope(cone), r = middle_radius(cone) + k * line.origin.y,
               growth = k * line.direction.y;
    const glm::dvec3 &o = line.origin, &d = line.direction;
    const Real a = Real(d.x) * d.x + Real(d.z) * d.z - growth * growth;
    const Real b = Real(o.x) * d.x + Real(o.z) * d.z - r * growth;
    const Real c = Real(o.x) * o.x + Real(o.z) * o.z - r * r;
    const Real rest = b * b - a * c;
    if (a == 0 && b == 0) return c < 0 ? planes : kNowhere;
    if (a == 0) {
        const double only = double(-c / (2 * b));
        return intersection(planes, b > 0 ? Span{-kInfinity, only} : Span{only, kInfinity});
    }
    if (rest <= 0) return a > 0 ? kNowhere : planes;
    const Real q = -(b + std::copysign(std::sqrt(rest), b)), one = q / a,
               other = q == 0 ? one : c / q;
    const Span between{double(std::min(one, other)), double(std::max(one, other))};
    if (a > 0) return intersection(planes, between);
    const Span before = intersection(planes, {-kInfinity, between.first});
    return before.first < before.last ? before : intersection(planes, {between.last, kInfinity});
}

Span in_convex(const Solid& solid, const Line& line) {
    switch (solid.kind) {
        case SolidKind::sphere:
            return in_sphere(line, solid.radius);
        case SolidKind::ellipsoid:
            return in_sphere({line.origin / solid.radii, line.direction / solid.radii}, 1);
        case SolidKind::slab:
            return between_planes(line, 1, solid.thickness / 2);
        case SolidKind::box:
            return intersection(between_planes(line, 0, solid.size.x / 2),
                                intersection(between_planes(line, 1, solid.size.y / 2),
                                             between_planes(line, 2, solid.size.z / 2)));
        case SolidKind::cylinder:
            return intersection(in_endless_cylinder(line, solid.radius),
                                between_planes(line, 1, solid.height / 2));
        case SolidKind::cone:
            return in_cone(solid, line);
        case SolidKind::capsule: {
            Span side = intersection(in_endless_cylinder(line, solid.radius),
                                     between_planes(line, 1, solid.height / 2));
            side.first_face = side.last_face = kCurved;
            return hull(side, hull(in_sphere(shifted(line, solid.height / 2), solid.radius),
                                   in_sphere(shifted(line, -solid.height / 2), solid.radius)));
        }
        default:
            throw std::invalid_argument("the analytic tracer doesn't know this kind of solid");
    }
}

/// The crossings of a torus, (|p|^2 + R^2 - r^2)^2 < 4 R^2 (x^2 + z^2). t counts from the line's
/// point nearest to the centre, so that |p|^2 has no linear term.
Crossings torus_crossings(const Solid& torus, const Line& line) {
    using Real = long double;
    const double reach = torus.radius + torus.tube;
    const Span span = in_sphere(line, reach * (1 + 1e-9));
    Crossings found;
    if (span.first >= span.last) return found;
    using Vector = glm::vec<3, Real>;
    const double middle = (span.first + span.last) / 2;
    const Vector d(line.direction), o = Vector(line.origin) + d * Real(middle);
    const Real ring = torus.radius, tube = torus.tube, four = 4 * ring * ring;
    const Real dd = glm::dot(d, d), od = glm::dot(o, d),
               s = glm::dot(o, o) + ring * ring - tube * tube;
    const std::vector<Real> quartic = {
        s * s - four * (o.x * o.x + o.z * o.z), 4 * od * s - 2 * four * (o.x * d.x + o.z * d.z),
        2 * dd * s + 4 * od * od - four * (d.x * d.x + d.z * d.z), 4 * dd * od, dd * dd};
    bool enters = true;
    for (const Real t : sign_changes(quartic, span.first - middle, span.last - middle)) {
        found.list[size_t(found.count++)] = {double(t + middle), enters, kCurved};
        enters = !enters;
    }
    return found;
}

/// The gradient of the solid's function at p. It is not of unit length.
glm::dvec3 gradient(const Solid& solid, const glm::dvec3& p) {
    switch (solid.kind) {
        case SolidKind::ellipsoid:
            return p / (solid.radii * solid.radii);
        case SolidKind::cylinder:
            return {p.x, 0, p.z};
        case SolidKind::cone: {
            const double across = std::hypot(p.x, p.z);
            return {p.x / across, -slope(solid), p.z / across};
        }
        case SolidKind::capsule:
            return {p.x, p.y - std::clamp(p.y, -solid.height / 2, solid.height / 2), p.z};
        case SolidKind::torus: {
            const double to_ring = 1 - solid.radius / std::hypot(p.x, p.z);
            return {p.x * to_ring, p.y, p.z * to_ring};
        }
        default:
            return p;
    }
}

}  // namespace

PlacedSolid::PlacedSolid(const Solid& solid, const glm::dmat4& world_from_solid)
    : solid_(solid), solid_from_world_(glm::inverse(world_from_solid * solid.parent_from_solid)) {
    if (is_combination(solid.kind))
        throw std::invalid_argument("the analytic tracer doesn't know this kind of solid");
}

// An affine map keeps t, so the crossings of the local line are those in the world.
Crossings PlacedSolid::crossings(const Line& line) const {
    const Line local{glm::dvec3(solid_from_world_ * glm::dvec4(line.origin, 1)),
                     glm::dmat3(solid_from_world_) * line.direction};
    if (solid_.kind == SolidKind::torus) return torus_crossings(solid_, local);
    const Span span = in_convex(solid_, local);
    Crossings found;
    if (span.first >= span.last) return found;
    if (span.first > -kInfinity)
        found.list[size_t(found.count++)] = {span.first, true, span.first_face};
    if (span.last < kInfinity)
        found.list[size_t(found.count++)] = {span.last, false, span.last_face};
    return found;
}

glm::dvec3 PlacedSolid::normal(const glm::dvec3& point, int face) const {
    glm::dvec3 local(0);
    if (face == kCurved) {
        local = gradient(solid_, glm::dvec3(solid_from_world_ * glm::dvec4(point, 1)));
    } else {
        local[(face - 1) / 2] = face % 2 == 0 ? 1 : -1;
    }
    return glm::normalize(glm::transpose(glm::dmat3(solid_from_world_)) * local);
}

}  // namespace voxelume::oracle
