// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_creases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <span>
#include <utility>
#include <vector>

namespace voxelume {
namespace {

/// For each position the number of the first one at the same place.
std::vector<uint32_t> places_of(const Mesh& mesh) {
    std::vector<uint32_t> order(mesh.positions.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto point = [&](uint32_t i) {
        const glm::vec3 p = mesh.positions[i] + 0.0f;  // -0 is 0
        return std::array{p.x, p.y, p.z};
    };
    std::ranges::sort(order, {}, point);
    std::vector<uint32_t> place(order.size());
    for (size_t i = 0; i < order.size(); ++i)
        place[order[i]] =
            i > 0 && point(order[i]) == point(order[i - 1]) ? place[order[i - 1]] : order[i];
    return place;
}

/// One side of a triangle.
struct Side {
    uint32_t low, high;  ///< its ends, the lower number first
    int direction;       ///< 1 if the triangle runs from `low` to `high`, else -1
    uint32_t triangle;

    std::pair<uint32_t, uint32_t> ends() const { return {low, high}; }
};

glm::dvec3 normal_of(const Mesh& mesh, uint32_t number) {
    const glm::uvec3& t = mesh.triangles[number];
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    return glm::cross(b - a, c - a);
}

/// The sides of all triangles with an area, those of one edge next to each other.
std::vector<Side> sorted_sides(const Mesh& mesh) {
    const std::vector<uint32_t> place = places_of(mesh);
    std::vector<Side> sides;
    sides.reserve(mesh.triangles.size() * 3);
    for (uint32_t number = 0; number < mesh.triangles.size(); ++number) {
        const glm::uvec3& triangle = mesh.triangles[number];
        for (int corner = 0; corner < 3; ++corner) {
            const uint32_t a = place[triangle[corner]], b = place[triangle[(corner + 1) % 3]];
            if (a != b) sides.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1, number});
        }
    }
    std::ranges::sort(sides, {},
                      [](const Side& side) { return std::pair(side.ends(), side.triangle); });
    return sides;
}

/// The turn of the surface at an edge, in degrees; 0 where a face has no area.
double turn_at(const Mesh& mesh, std::span<const Side> sides) {
    const glm::dvec3 a = normal_of(mesh, sides[0].triangle), b = normal_of(mesh, sides[1].triangle);
    // Faces that run along the edge in one direction look to different sides of the surface.
    const double sign = sides[0].direction == sides[1].direction ? -1 : 1;
    if (a == glm::dvec3(0) || b == glm::dvec3(0)) return 0;
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), sign * glm::dot(a, b)));
}

}  // namespace

double sharp_length_of(const Mesh& mesh) {
    const std::vector<Side> sides = sorted_sides(mesh);
    double sum = 0;
    for (size_t first = 0, end = 0; first < sides.size(); first = end) {
        while (end < sides.size() && sides[end].ends() == sides[first].ends()) ++end;
        if (end - first == 1) continue;  // an open edge
        const auto here = std::span(sides).subspan(first, end - first);
        if (here.size() > 2 || turn_at(mesh, here) >= kSharpAngle)
            sum += glm::distance(glm::dvec3(mesh.positions[sides[first].low]),
                                 glm::dvec3(mesh.positions[sides[first].high]));
    }
    return sum;
}

}  // namespace voxelume
