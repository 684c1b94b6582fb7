// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/mesh/triangle_distance.hpp"

#include <algorithm>

namespace voxelume::oracle {
namespace {

using Vector = glm::vec<3, long double>;

long double distance_to_segment(const Vector& p, const Vector& a, const Vector& b) {
    const long double squared = glm::dot(b - a, b - a);
    if (squared == 0) return glm::length(p - a);
    const long double t = std::clamp<long double>(glm::dot(p - a, b - a) / squared, 0, 1);
    return glm::length(p - a - t * (b - a));
}

}  // namespace

double distance_to_triangle(const glm::dvec3& p_, const glm::dvec3& a_, const glm::dvec3& b_,
                            const glm::dvec3& c_) {
    const Vector p(p_), a(a_), b(b_), c(c_);
    const long double edges = std::min(
        {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
    const Vector n = glm::cross(b - a, c - a);
    const long double area = glm::length(n);
    if (area == 0) return static_cast<double>(edges);
    const Vector unit = n / area, foot = p - unit * glm::dot(unit, p - a);
    const bool inside = glm::dot(glm::cross(b - a, foot - a), n) >= 0 &&
                        glm::dot(glm::cross(c - b, foot - b), n) >= 0 &&
                        glm::dot(glm::cross(a - c, foot - c), n) >= 0;
    return static_cast<double>(inside ? std::min(edges, std::abs(glm::dot(unit, p - a))) : edges);
}

}  // namespace voxelume::oracle
