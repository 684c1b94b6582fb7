// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/mesh/mesh_distance.hpp"

#include <algorithm>
#include <limits>

namespace voxelume::oracle {
namespace {

double squared(const glm::dvec3& v) {
    return glm::dot(v, v);
}

double squared_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 edge = b - a;
    const double length = squared(edge);
    if (length == 0) return squared(p - a);
    return squared(p - a - edge * std::clamp(glm::dot(p - a, edge) / length, 0.0, 1.0));
}

/// The squared distance to the plane if the foot of `p` lies inside the triangle, else to the
/// nearest edge.
double squared_to_triangle(const glm::dvec3& p, const Triangle& t) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double area = squared(normal);
    bool inside = area > 0;
    for (size_t i = 0; i < 3 && inside; ++i)
        inside = glm::dot(glm::cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) >= 0;
    if (inside) {
        const double height = glm::dot(p - t[0], normal);
        return height * height / area;
    }
    return std::min({squared_to_segment(p, t[0], t[1]), squared_to_segment(p, t[1], t[2]),
                     squared_to_segment(p, t[2], t[0])});
}

double squared_to_box(const glm::dvec3& p, const MeshTree::Node& box) {
    return squared(glm::max(glm::max(box.low - p, p - box.high), glm::dvec3(0)));
}

void search(const MeshTree& mesh, const glm::dvec3& p, uint32_t number, double& nearest) {
    const MeshTree::Node& node = mesh.nodes()[number];
    for (uint32_t i = node.first; i < node.first + node.count; ++i)
        nearest = std::min(nearest, squared_to_triangle(p, mesh.triangles()[mesh.order()[i]]));
    if (node.count > 0 || mesh.order().empty()) return;
    const double left = squared_to_box(p, mesh.nodes()[node.first]);
    const double right = squared_to_box(p, mesh.nodes()[node.first + 1]);
    const uint32_t near = node.first + (right < left ? 1 : 0);
    const uint32_t far = node.first + (right < left ? 0 : 1);
    if (std::min(left, right) < nearest) search(mesh, p, near, nearest);
    if (std::max(left, right) < nearest) search(mesh, p, far, nearest);
}

}  // namespace

double distance_to_mesh(const MeshTree& mesh, const glm::dvec3& point) {
    double nearest = std::numeric_limits<double>::infinity();
    search(mesh, point, 0, nearest);
    return std::sqrt(nearest);
}

}  // namespace voxelume::oracle
