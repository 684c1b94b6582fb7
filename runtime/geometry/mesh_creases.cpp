// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_creases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>
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

/// An edge of the mesh at which the surface turns sharply.
struct SharpEdge {
    std::array<uint32_t, 2> ends{};
    double length = 0;
};

std::vector<SharpEdge> sharp_edges(const Mesh& mesh) {
    const std::vector<Side> sides = sorted_sides(mesh);
    std::vector<SharpEdge> edges;
    for (size_t first = 0, end = 0; first < sides.size(); first = end) {
        while (end < sides.size() && sides[end].ends() == sides[first].ends()) ++end;
        if (end - first == 1) continue;  // an open edge
        const auto here = std::span(sides).subspan(first, end - first);
        if (here.size() > 2 || turn_at(mesh, here) >= kSharpAngle) {
            const auto [low, high] = sides[first].ends();
            edges.push_back(
                {{low, high},
                 glm::distance(glm::dvec3(mesh.positions[low]), glm::dvec3(mesh.positions[high]))});
        }
    }
    return edges;
}

/// Follows sharp edges from one to the next that goes on straightest.
class Creases {
  public:
    Creases(const Mesh& mesh, std::vector<SharpEdge> edges)
        : mesh_(mesh), edges_(std::move(edges)), is_used_(edges_.size()) {
        for (uint32_t i = 0; i < edges_.size(); ++i)
            for (const uint32_t end : edges_[i].ends) at_.emplace_back(end, i);
        std::ranges::sort(at_);
    }

    /// The length of the crease that `edge` is part of; its edges are part of no other. 0 if it is
    /// part of one already.
    double length_through(uint32_t edge) {
        if (is_used_[edge]) return 0;
        is_used_[edge] = true;
        double sum = edges_[edge].length;
        for (const uint32_t end : edges_[edge].ends) {
            uint32_t last = edge, place = end;
            while (const auto next = next_of(last, place)) {
                is_used_[*next] = true;
                sum += edges_[*next].length;
                place = other_end(*next, place);
                last = *next;
            }
        }
        return sum;
    }

  private:
    uint32_t other_end(uint32_t edge, uint32_t place) const {
        const auto& ends = edges_[edge].ends;
        return ends[0] == place ? ends[1] : ends[0];
    }

    glm::dvec3 direction(uint32_t from, uint32_t to) const {
        const glm::dvec3 way = glm::dvec3(mesh_.positions[to]) - glm::dvec3(mesh_.positions[from]);
        return way / glm::length(way);
    }

    /// The unused edge at `place` that goes on from `edge` with the least turn.
    std::optional<uint32_t> next_of(uint32_t edge, uint32_t place) const {
        const glm::dvec3 onward = direction(other_end(edge, place), place);
        std::optional<uint32_t> best;
        double straightest = kStraight;
        auto here = std::ranges::lower_bound(at_, std::pair(place, 0u));
        for (; here != at_.end() && here->first == place; ++here) {
            const uint32_t candidate = here->second;
            if (is_used_[candidate]) continue;
            const double cosine = glm::dot(onward, direction(place, other_end(candidate, place)));
            if (cosine < straightest) continue;
            straightest = cosine;
            best = candidate;
        }
        return best;
    }

    /// A crease turns by at most 60 degrees from edge to edge: a hexagon is one crease.
    static constexpr double kStraight = 0.4999;

    const Mesh& mesh_;
    std::vector<SharpEdge> edges_;
    std::vector<bool> is_used_;
    std::vector<std::pair<uint32_t, uint32_t>> at_;  ///< place and edge, sorted
};

double longest_side(const Mesh& mesh) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::uvec3& triangle : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner) {
            const glm::dvec3 point(mesh.positions[triangle[corner]]);
            low = glm::min(low, point);
            high = glm::max(high, point);
        }
    return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

}  // namespace

double sharp_length_of(const Mesh& mesh) {
    if (mesh.triangles.empty()) return 0;
    const std::vector<SharpEdge> edges = sharp_edges(mesh);
    const double shortest = kCreaseShare * longest_side(mesh);
    Creases creases(mesh, edges);
    double sum = 0;
    for (uint32_t i = 0; i < edges.size(); ++i)
        if (const double length = creases.length_through(i); length >= shortest) sum += length;
    return sum;
}

}  // namespace voxelume
