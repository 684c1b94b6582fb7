// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/analytic/analytic_ray.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

using Hit = std::optional<AnalyticHit>;

Hit sphere_hit(const Solid& sphere, const glm::dvec3& origin, const glm::dvec3& direction) {
    const double nearest = -glm::dot(origin, direction);
    const glm::dvec3 across = origin + nearest * direction;
    const double square = sphere.radius * sphere.radius - glm::dot(across, across);
    if (square < 0) return {};
    const double t = nearest - std::sqrt(square);
    if (t < 0) return {};
    return AnalyticHit{t, (origin + t * direction) / sphere.radius};
}

Hit box_hit(const Solid& box, const glm::dvec3& origin, const glm::dvec3& direction) {
    double first = -INFINITY, last = INFINITY;
    int face = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double half = box.size[axis] / 2;
        if (direction[axis] == 0) {
            if (std::abs(origin[axis]) > half) return {};
            continue;
        }
        const double a = (-half - origin[axis]) / direction[axis];
        const double b = (half - origin[axis]) / direction[axis];
        if (std::min(a, b) > first) first = std::min(a, b), face = axis;
        last = std::min(last, std::max(a, b));
    }
    if (first > last || first < 0) return {};
    AnalyticHit hit{first, glm::dvec3(0)};
    hit.normal[face] = direction[face] > 0 ? -1 : 1;
    return hit;
}

/// The t in [low, high] where `value` changes its sign.
template <class Function>
double bisect(const Function& value, double low, double high) {
    const bool is_positive = value(low) > 0;
    for (;;) {
        const double middle = low + (high - low) / 2;
        if (!(middle > low && middle < high)) return high;
        ((value(middle) > 0) == is_positive ? low : high) = middle;
    }
}

using Polynomial = std::vector<double>;  // coefficients of 1, t, t^2, ...

double value_of(const Polynomial& p, double t) {
    double value = 0;
    for (size_t i = p.size(); i-- > 0;) value = value * t + p[i];
    return value;
}

/// The t between `low` and `high`, ascending, where a polynomial changes its sign. Between two
/// roots of its derivative it does so at most once.
std::vector<double> roots_of(const Polynomial& p, double low, double high) {
    if (p.size() < 2) return {};
    Polynomial derivative;
    for (size_t i = 1; i < p.size(); ++i) derivative.push_back(double(i) * p[i]);
    std::vector<double> cuts = roots_of(derivative, low, high);
    cuts.insert(cuts.begin(), low);
    cuts.push_back(high);
    const auto value = [&p](double t) { return value_of(p, t); };
    std::vector<double> roots;
    for (size_t i = 1; i < cuts.size(); ++i)
        if ((value(cuts[i - 1]) > 0) != (value(cuts[i]) > 0))
            roots.push_back(bisect(value, cuts[i - 1], cuts[i]));
    return roots;
}

/// The derivative of (|p|^2 + R^2 - r^2)^2 - 4 R^2 (x^2 + z^2) along a ray. `start` is
/// perpendicular to the ray, so that |p|^2 = s + t^2.
Polynomial torus_derivative(const Solid& torus, const glm::dvec3& start,
                            const glm::dvec3& direction) {
    const double ring = torus.radius * torus.radius;
    const double rest = glm::dot(start, start) + ring - torus.tube * torus.tube;
    const double b = start.x * direction.x + start.z * direction.z;
    const double c = direction.x * direction.x + direction.z * direction.z;
    return {-8 * ring * b, 4 * rest - 8 * ring * c, 0, 4};
}

Hit torus_hit(const Solid& torus, const glm::dvec3& origin, const glm::dvec3& direction) {
    const double nearest = -glm::dot(origin, direction);
    const glm::dvec3 start = origin + nearest * direction;
    const double reach = torus.radius + torus.tube;
    const double square = reach * reach - glm::dot(start, start);
    if (square < 0) return {};
    // The distance has the sign of the quartic and, unlike the quartic, no cancellation.
    const auto distance = [&](double t) {
        const glm::dvec3 p = start + t * direction;
        return std::hypot(std::hypot(p.x, p.z) - torus.radius, p.y) - torus.tube;
    };
    const double high = std::sqrt(square);
    std::vector<double> cuts = roots_of(torus_derivative(torus, start, direction), -high, high);
    cuts.push_back(high);
    double low = -high;
    for (const double cut : cuts) {
        if (distance(cut) <= 0) {
            const double t = bisect(distance, low, cut);
            if (nearest + t < 0) return {};
            const glm::dvec3 p = start + t * direction;
            const double to_axis = std::hypot(p.x, p.z);
            const glm::dvec3 ring(p.x / to_axis * torus.radius, 0, p.z / to_axis * torus.radius);
            return AnalyticHit{nearest + t, glm::normalize(p - ring)};
        }
        low = cut;
    }
    return {};
}

Hit hit_of(const Solid& solid, const glm::dvec3& origin, const glm::dvec3& direction) {
    switch (solid.kind) {
        case SolidKind::sphere:
            return sphere_hit(solid, origin, direction);
        case SolidKind::box:
            return box_hit(solid, origin, direction);
        case SolidKind::torus:
            return torus_hit(solid, origin, direction);
        default:
            throw Error(ErrorKind::render, "bench: a solid of kind {} has no analytic hit",
                        int(solid.kind));
    }
}

}  // namespace

bool has_analytic_hit(SolidKind kind) {
    return kind == SolidKind::sphere || kind == SolidKind::box || kind == SolidKind::torus;
}

std::optional<AnalyticHit> analytic_hit(const Solid& solid, const glm::dmat4& world_from_solid,
                                        const glm::dvec3& origin, const glm::dvec3& direction) {
    const glm::dmat3 turn(world_from_solid);
    const glm::dmat3 back = glm::transpose(turn);
    std::optional<AnalyticHit> hit =
        hit_of(solid, back * (origin - glm::dvec3(world_from_solid[3])), back * direction);
    if (hit) hit->normal = turn * hit->normal;
    return hit;
}

}  // namespace voxelume
