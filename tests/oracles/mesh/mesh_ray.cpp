// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/mesh/mesh_ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace voxelume::oracle {
namespace {

using Vector = glm::vec<3, long double>;

/// A ray as the axis `z` of a sheared space, in which its origin is 0.
struct Shear {
    Vector origin;
    int x, y, z;
    long double over_x, over_y,
        over_z;  ///< the direction's x and y divided by its z; 1 divided by its z

    Shear(const glm::dvec3& from, const glm::dvec3& direction) : origin(from) {
        const glm::dvec3 size = glm::abs(direction);
        z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        x = (z + 1) % 3, y = (z + 2) % 3;
        over_z = 1 / static_cast<long double>(direction[z]);
        over_x = direction[x] * over_z, over_y = direction[y] * over_z;
    }

    Vector operator()(const glm::dvec3& point) const {
        const Vector p = Vector(point) - origin;
        return {p[x] - over_x * p[z], p[y] - over_y * p[z], over_z * p[z]};
    }
};

/// Twice the area of (0, a, b), which is exactly the negative of that of (0, b, a).
long double area(const Vector& a, const Vector& b) {
    return a.x * b.y - a.y * b.x;
}

void meet(const Triangle& triangle, const Shear& shear, long double& nearest) {
    const Vector a = shear(triangle[0]), b = shear(triangle[1]), c = shear(triangle[2]);
    const long double u = area(b, c), v = area(c, a), w = area(a, b);
    if (std::min({u, v, w}) < 0 && std::max({u, v, w}) > 0) return;
    const long double sum = u + v + w;
    if (sum == 0) return;
    const long double t = (u * a.z + v * b.z + w * c.z) / sum;
    if (t > 0) nearest = std::min(nearest, t);
}

/// True if the ray may enter the box before `nearest`. The box is widened by far more than the
/// rounding of doubles.
bool may_enter(const MeshTree::Node& box, const glm::dvec3& origin, const glm::dvec3& direction,
               long double nearest) {
    const glm::dvec3 margin = 1e-9 * (glm::abs(box.low) + glm::abs(box.high) + glm::abs(origin));
    double first = 0, last = static_cast<double>(nearest) * (1 + 1e-9);
    for (int axis = 0; axis < 3; ++axis) {
        const double low = box.low[axis] - margin[axis] - origin[axis];
        const double high = box.high[axis] + margin[axis] - origin[axis];
        if (direction[axis] == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        const double a = low / direction[axis], b = high / direction[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last;
}

double distance_to_edge(const Edge& edge, const glm::dvec3& origin, const glm::dvec3& direction) {
    // The nearest points of a segment a + s e and a half line o + t d lie on their common
    // perpendicular or at an end of one of them.
    const Vector o(origin), d(direction), a(edge[0]), e = Vector(edge[1]) - a, r = a - o;
    const long double dd = glm::dot(d, d), ee = glm::dot(e, e), de = glm::dot(d, e);
    const long double common = dd * ee - de * de;
    const auto at = [&](long double s) {
        s = std::clamp(s, 0.0L, 1.0L);
        const Vector p = r + e * s;
        return glm::length(p - d * std::max(glm::dot(p, d) / dd, 0.0L));
    };
    long double nearest = std::min(at(0), at(1));
    if (common > 0)
        nearest = std::min(nearest, at((glm::dot(r, d) * de - glm::dot(r, e) * dd) / common));
    if (ee > 0) nearest = std::min(nearest, at(-glm::dot(r, e) / ee));
    return static_cast<double>(nearest);
}

struct PointLess {
    bool operator()(const glm::dvec3& a, const glm::dvec3& b) const {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
};

/// The numbers of triangles at an edge that are seen from the front and from the back.
struct Sides {
    int front = 0, back = 0;
};

}  // namespace

std::optional<double> first_hit(const MeshTree& mesh, const glm::dvec3& origin,
                                const glm::dvec3& direction) {
    const Shear shear(origin, direction);
    long double nearest = std::numeric_limits<double>::infinity();
    std::vector<uint32_t> waiting = {0};
    while (!waiting.empty()) {
        const MeshTree::Node& node = mesh.nodes()[waiting.back()];
        waiting.pop_back();
        if (!may_enter(node, origin, direction, nearest)) continue;
        for (uint32_t i = node.first; i < node.first + node.count; ++i)
            meet(mesh.triangles()[mesh.order()[i]], shear, nearest);
        if (node.count > 0 || mesh.order().empty()) continue;
        const auto ahead = [&](uint32_t child) {
            const MeshTree::Node& n = mesh.nodes()[child];
            return glm::dot(n.low + n.high, direction);
        };
        const uint32_t far = ahead(node.first) < ahead(node.first + 1) ? 1 : 0;
        waiting.push_back(node.first + far);
        waiting.push_back(node.first + 1 - far);
    }
    if (std::isinf(nearest)) return std::nullopt;
    return static_cast<double>(nearest);
}

std::vector<Edge> silhouette_edges(const std::vector<Triangle>& triangles, const glm::dvec3& eye) {
    std::map<glm::dvec3, uint32_t, PointLess> numbers;
    std::map<std::pair<uint32_t, uint32_t>, Sides> edges;
    for (const Triangle& t : triangles) {
        std::array<uint32_t, 3> corner;
        for (size_t i = 0; i < 3; ++i)
            corner[i] =
                numbers.try_emplace(t[i], static_cast<uint32_t>(numbers.size())).first->second;
        const Vector a(t[0]), normal = glm::cross(Vector(t[1]) - a, Vector(t[2]) - a);
        const long double facing = glm::dot(normal, Vector(eye) - a);
        for (size_t i = 0; i < 3; ++i) {
            Sides& sides = edges[std::minmax(corner[i], corner[(i + 1) % 3])];
            if (facing >= 0) ++sides.front;
            // Edge-on counts as both, so the triangle's edges are silhouette edges.
            if (facing <= 0) ++sides.back;
        }
    }
    std::vector<glm::dvec3> points(numbers.size());
    for (const auto& [point, number] : numbers) points[number] = point;
    std::vector<Edge> found;
    for (const auto& [ends, sides] : edges)
        if (!((sides.front == 2 && sides.back == 0) || (sides.front == 0 && sides.back == 2)))
            found.push_back({points[ends.first], points[ends.second]});
    return found;
}

double distance_to_edges(const std::vector<Edge>& edges, const glm::dvec3& origin,
                         const glm::dvec3& direction) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Edge& edge : edges)
        nearest = std::min(nearest, distance_to_edge(edge, origin, direction));
    return nearest;
}

}  // namespace voxelume::oracle
