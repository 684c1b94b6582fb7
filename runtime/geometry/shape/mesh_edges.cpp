// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/shape/mesh_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <span>
#include <utility>

namespace voxelume {
namespace {

/// For each position the index of the first one that is equal to it.
std::vector<uint32_t> find_first_equal(const Mesh& mesh) {
    std::vector<uint32_t> order(mesh.positions.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto point = [&](uint32_t i) {
        const glm::vec3 p = mesh.positions[i] + 0.0f;  // -0 is 0
        return std::array{p.x, p.y, p.z};
    };
    std::ranges::sort(order, {}, point);
    std::vector<uint32_t> first(order.size());
    for (size_t i = 0; i < order.size(); ++i)
        first[order[i]] =
            i > 0 && point(order[i]) == point(order[i - 1]) ? first[order[i - 1]] : order[i];
    return first;
}

/// One side of a triangle.
struct Side {
    uint32_t low, high;  ///< its ends, the lower number first
    bool is_up;          ///< the triangle runs from `low` to `high`
    uint32_t number;

    std::pair<uint32_t, uint32_t> ends() const { return {low, high}; }
};

/// The sides of all triangles, those of one edge next to each other.
std::vector<Side> sorted_sides(const Mesh& mesh, const std::vector<uint32_t>& first_equal) {
    std::vector<Side> sides;
    sides.reserve(mesh.triangles.size() * 3);
    for (uint32_t number = 0; number < mesh.triangles.size(); ++number) {
        const glm::uvec3& triangle = mesh.triangles[number];
        for (int corner = 0; corner < 3; ++corner) {
            const uint32_t a = first_equal[triangle[corner]],
                           b = first_equal[triangle[(corner + 1) % 3]];
            if (a != b)
                sides.push_back(
                    {std::min(a, b), std::max(a, b), a < b, number * 3 + uint32_t(corner)});
        }
    }
    std::ranges::sort(sides, {},
                      [](const Side& side) { return std::pair(side.ends(), side.number); });
    return sides;
}

/// The unit normals of the triangles; 0 without an area.
std::vector<glm::dvec3> normals_of(const Mesh& mesh) {
    std::vector<glm::dvec3> normals;
    normals.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double length = glm::length(normal);
        normals.push_back(length > 0 ? normal / length : glm::dvec3(0));
    }
    return normals;
}

/// Faces whose normals have a larger cosine than this count as coplanar: single precision turns
/// faces of millimetres in a mesh of metres by that much.
constexpr double kSameFace = 0.9999;  // 0.8 degrees

/// Keeps one of an edge's sides for each group of faces that lie in each other and look to the same
/// side. Faces without an area lie in all others.
void leave_distinct(const std::vector<glm::dvec3>& normals, std::vector<Side>& sides) {
    std::vector<Side> distinct;
    for (const Side& side : sides) {
        const glm::dvec3& normal = normals[side.number / 3];
        const auto is_same = [&](const Side& other) {
            return other.is_up == side.is_up &&
                   glm::dot(normal, normals[other.number / 3]) > kSameFace;
        };
        if (normal != glm::dvec3(0) && std::ranges::none_of(distinct, is_same))
            distinct.push_back(side);
    }
    sides = std::move(distinct);
}

}  // namespace

MeshEdges::MeshEdges(const Mesh& mesh)
    : mesh_(mesh),
      first_equal_(find_first_equal(mesh)),
      normals_(normals_of(mesh)),
      across_(mesh.triangles.size() * 3, kNoSide) {
    const std::vector<Side> sides = sorted_sides(mesh, first_equal_);
    edges_.reserve(sides.size() / 2);
    std::vector<Side> here;
    for (size_t first = 0, end = 0; first < sides.size(); first = end) {
        while (end < sides.size() && sides[end].ends() == sides[first].ends()) ++end;
        const auto all = std::span(sides).subspan(first, end - first);
        here.assign(all.begin(), all.end());
        if (here.size() > 2) leave_distinct(normals_, here);
        if (here.size() < 2) continue;  // an open edge
        edges_.push_back({here[0].number, here[1].number, here.size() > 2});
        if (here.size() > 2) continue;
        for (const Side& side : all)
            across_[side.number] = here[side.is_up == here[0].is_up ? 1 : 0].number;
        across_[here[0].number] = here[1].number;  // alike if one looks inwards
        across_[here[1].number] = here[0].number;
    }
}

double turn_at(const MeshEdges& edges, const MeshEdge& edge) {
    const glm::dvec3 &a = edges.normal(edge.a), &b = edges.normal(edge.b);
    if (a == glm::dvec3(0) || b == glm::dvec3(0)) return 0;
    const double cosine = edges.sense(edge.a, edge.b) * glm::dot(a, b);
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), cosine));
}

}  // namespace voxelume
