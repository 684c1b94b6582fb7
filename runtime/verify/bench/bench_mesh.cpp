// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <numeric>

#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/scene/parts/scene_affine.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kLeafTriangles = 4;

/// A ray as the axis `z` of a sheared space in which it starts at 0 (Woop, Benthin & Wald 2013).
/// Neighbouring triangles evaluate their common edge to opposite numbers.
struct ShearedRay {
    glm::dvec3 origin, direction, inverse;
    int x, y, z;
    double over_x, over_y, over_z;

    ShearedRay(const glm::dvec3& from, const glm::dvec3& along)
        : origin(from), direction(along), inverse(1.0 / along) {
        const glm::dvec3 size = glm::abs(along);
        z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        x = (z + 1) % 3, y = (z + 2) % 3;
        over_z = 1 / along[z];
        over_x = along[x] * over_z, over_y = along[y] * over_z;
    }

    glm::dvec3 operator()(const glm::dvec3& point) const {
        const glm::dvec3 p = point - origin;
        return {p[x] - over_x * p[z], p[y] - over_y * p[z], over_z * p[z]};
    }
};

double area(const glm::dvec3& a, const glm::dvec3& b) {
    return a.x * b.y - a.y * b.x;
}

/// The t where the ray meets the triangle; infinity if it doesn't.
double meet(const glm::dvec3* corners, const ShearedRay& ray) {
    const glm::dvec3 a = ray(corners[0]), b = ray(corners[1]), c = ray(corners[2]);
    const double u = area(b, c), v = area(c, a), w = area(a, b), sum = u + v + w;
    if ((std::min({u, v, w}) < 0 && std::max({u, v, w}) > 0) || sum == 0) return INFINITY;
    const double t = (u * a.z + v * b.z + w * c.z) / sum;
    return t > 0 ? t : INFINITY;
}

/// True if the ray may enter the box before `nearest`, with more tolerance than doubles need.
bool may_enter(const glm::dvec3& low, const glm::dvec3& high, const ShearedRay& ray,
               double nearest) {
    constexpr double kRoom = 1e-12;  // in metres, for a scene of some metres
    double first = 0, last = nearest;
    for (int axis = 0; axis < 3; ++axis) {
        const double from = low[axis] - kRoom - ray.origin[axis];
        const double to = high[axis] + kRoom - ray.origin[axis];
        if (ray.direction[axis] == 0) {
            if (from > 0 || to < 0) return false;
            continue;
        }
        const double a = from * ray.inverse[axis], b = to * ray.inverse[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last * (1 + 1e-12);
}

}  // namespace

MeshTruth::MeshTruth(const Mesh& mesh, const glm::dmat4& world_from_mesh)
    : order_(mesh.triangles.size()) {
    for (const glm::uvec3& triangle : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            corners_.emplace_back(world_from_mesh *
                                  glm::dvec4(glm::dvec3(mesh.positions[triangle[i]]), 1));
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.emplace_back();
    split(0, 0, uint32_t(order_.size()));
}

void MeshTruth::split(uint32_t node, uint32_t first, uint32_t count) {
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (uint32_t i = first; i < first + count; ++i)
        for (uint32_t k = 0; k < 3; ++k) {
            low = glm::min(low, corners_[order_[i] * 3 + k]);
            high = glm::max(high, corners_[order_[i] * 3 + k]);
        }
    nodes_[node] = {low, high, first, count};
    if (count <= kLeafTriangles) return;
    const glm::dvec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto middle = [&](uint32_t number) {
        return corners_[number * 3][axis] + corners_[number * 3 + 1][axis] +
               corners_[number * 3 + 2][axis];
    };
    const uint32_t half = count / 2;
    std::nth_element(order_.begin() + first, order_.begin() + first + half,
                     order_.begin() + first + count,
                     [&](uint32_t a, uint32_t b) { return middle(a) < middle(b); });
    const auto child = uint32_t(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].first = child, nodes_[node].count = 0;
    split(child, first, half);
    split(child + 1, first + half, count - half);
}

std::optional<AnalyticHit> MeshTruth::first_hit(const glm::dvec3& origin,
                                                const glm::dvec3& direction) const {
    const ShearedRay ray(origin, direction);
    double nearest = INFINITY;
    uint32_t met = 0;
    std::array<uint32_t, 64> waiting{};
    size_t count = 1;
    while (count > 0) {
        const Node& node = nodes_[waiting[--count]];
        if (!may_enter(node.low, node.high, ray, nearest)) continue;
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            const double t = meet(&corners_[order_[i] * 3], ray);
            if (t < nearest) nearest = t, met = order_[i];
        }
        if (node.count > 0 || order_.empty()) continue;
        const auto ahead = [&](uint32_t child) {
            return glm::dot(nodes_[child].low + nodes_[child].high, direction);
        };
        const uint32_t far = ahead(node.first) < ahead(node.first + 1) ? 1 : 0;
        waiting[count++] = node.first + far;
        waiting[count++] = node.first + 1 - far;
    }
    if (std::isinf(nearest)) return {};
    const glm::dvec3* t = &corners_[met * 3];
    const glm::dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    return AnalyticHit{nearest, glm::dot(normal, direction) > 0 ? -normal : normal};
}

BenchSubject bunny_subject() {
    const Mesh mesh = read_mesh(kBunnyFile);
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (const glm::vec3& p : mesh.positions)
        low = glm::min(low, glm::dvec3(p)), high = glm::max(high, glm::dvec3(p));
    const glm::dvec3 extent = high - low;
    const double scale = 0.9 / std::max({extent.x, extent.y, extent.z});
    const glm::dmat4 placement =
        affine_from_factors(-scale * (low + high) / 2.0, {0, 0, 0}, glm::dvec3(scale));
    const auto truth = std::make_shared<const MeshTruth>(mesh, placement);
    BenchSubject subject;
    subject.name = "bunny";
    subject.scene = [placement](Surface surface, int resolution, glm::ivec2 size) {
        Scene scene = empty_bench_scene(resolution, size);
        Model model;
        model.name = "bunny";
        model.mesh = kBunnyFile;
        add_bench_object(scene, std::move(model), surface, resolution, placement);
        return scene;
    };
    subject.extent = truth->extent();
    subject.first_hit = [truth](const glm::dvec3& origin, const glm::dvec3& direction) {
        return truth->first_hit(origin, direction);
    };
    return subject;
}

}  // namespace voxelume
