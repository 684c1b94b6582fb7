// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/display_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace voxelume::oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

double SimpleSolid::distance(const glm::dvec3& p) const {
    if (radius > 0) return glm::length(p - center) - radius;
    const glm::dvec3 q = glm::abs(glm::transpose(axes) * (p - center)) - half;
    return glm::length(glm::max(q, glm::dvec3(0))) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

std::optional<SimpleSolid::Span> SimpleSolid::span(const glm::dvec3& origin,
                                                   const glm::dvec3& direction) const {
    if (radius > 0) {
        const glm::dvec3 o = origin - center;
        const double a = glm::dot(direction, direction), b = glm::dot(o, direction);
        const glm::dvec3 nearest = o - direction * (b / a);
        const double left = radius * radius - glm::dot(nearest, nearest);
        if (left <= 0) return std::nullopt;
        const double h = std::sqrt(left / a);
        return Span{-b / a - h, -b / a + h};
    }
    const glm::dvec3 o = glm::transpose(axes) * (origin - center);
    const glm::dvec3 d = glm::transpose(axes) * direction;
    Span s{-kInfinity, kInfinity};
    for (int i = 0; i < 3; ++i) {
        if (d[i] == 0) {
            if (std::abs(o[i]) > half[i]) return std::nullopt;
            continue;
        }
        const double t = (-half[i] - o[i]) / d[i], u = (half[i] - o[i]) / d[i];
        s.enter = std::max(s.enter, std::min(t, u));
        s.leave = std::min(s.leave, std::max(t, u));
    }
    if (s.enter >= s.leave) return std::nullopt;
    return s;
}

std::vector<glm::dvec3> SimpleSolid::surface_points(double spacing) const {
    std::vector<glm::dvec3> points;
    if (radius > 0) {  // a spiral from pole to pole (Saff and Kuijlaars 1997)
        const double area = 4 * 3.141592653589793 * radius * radius;
        const int count = int(2 * area / (spacing * spacing)) + 1;
        for (int i = 0; i < count; ++i) {
            const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z);
            const double angle = 2.399963229728653 * i;
            points.push_back(center +
                             radius * glm::dvec3(r * std::cos(angle), z, r * std::sin(angle)));
        }
        return points;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        const int na = int(2 * half[a] / spacing) + 2, nb = int(2 * half[b] / spacing) + 2;
        for (int i = 0; i < na; ++i)
            for (int j = 0; j < nb; ++j)
                for (const double side : {-1.0, 1.0}) {
                    glm::dvec3 p;
                    p[axis] = side * half[axis];
                    p[a] = half[a] * ((2 * i + 1.0) / na - 1);
                    p[b] = half[b] * ((2 * j + 1.0) / nb - 1);
                    points.push_back(center + axes * p);
                }
    }
    return points;
}

double SimpleScene::distance(const glm::dvec3& p) const {
    double minimum = kInfinity;
    for (const SimpleSolid& solid : solids)
        minimum = std::min(minimum, std::abs(solid.distance(p)));
    return minimum;
}

std::optional<double> SimpleScene::first_hit(const glm::dvec3& origin, const glm::dvec3& direction,
                                             double first) const {
    double minimum = kInfinity;
    for (const SimpleSolid& solid : solids) {
        const auto s = solid.span(origin, direction);
        if (!s) continue;
        for (const double t : {s->enter, s->leave})
            if (t >= first) minimum = std::min(minimum, t);
    }
    if (std::isinf(minimum)) return std::nullopt;
    return minimum;
}

bool SimpleScene::is_seen(const glm::dvec3& from, const glm::dvec3& p, double clear) const {
    const double length = glm::length(p - from);
    const auto t = first_hit(from, (p - from) / length, 0);
    return !t || *t >= length - clear;
}

}  // namespace voxelume::oracle
