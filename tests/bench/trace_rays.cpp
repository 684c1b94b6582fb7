// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/trace_rays.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <random>

#include "runtime/io/mesh/mesh_reader.hpp"

namespace voxelume {

std::vector<Ray> picture_rays(const GridFrame& frame) {
    const glm::dvec3 eye = glm::normalize(glm::dvec3(0.5, 0.35, 1)) * 1.8;
    const glm::dvec3 ahead = glm::normalize(-eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(right, ahead);
    const double half = std::tan(glm::radians(20.0));
    std::vector<Ray> rays;
    for (int index = 0; index < kPictureSide * kPictureSide; ++index) {
        const int tile = index / 16, pixel = index % 16;
        const int column = tile % (kPictureSide / 4) * 4 + pixel % 4;
        const int row = tile / (kPictureSide / 4) * 4 + pixel / 4;
        const double u = (2.0 * column + 1) / kPictureSide - 1,
                     v = 1 - (2.0 * row + 1) / kPictureSide;
        const glm::dvec3 direction =
            (ahead + right * (u * half) + up * (v * half)) / frame.voxel_edge;
        const glm::dvec3 origin = (eye - frame.origin) / frame.voxel_edge;
        double first = 0, last = INFINITY;
        for (int a = 0; a < 3; ++a) {
            const double p = -origin[a] / direction[a];
            const double q = (frame.size[a] - origin[a]) / direction[a];
            first = std::max(first, std::min(p, q));
            last = std::min(last, std::max(p, q));
        }
        const glm::dvec3 entry = origin + direction * (first > last ? 0 : first);
        rays.push_back({glm::clamp(entry, glm::dvec3(0), glm::dvec3(frame.size)), direction,
                        first > last ? -1.0f : INFINITY});
    }
    return rays;
}

RayLists split_rays(const std::vector<Ray>& rays, const std::vector<Hit>& hits,
                    const GridFrame& frame) {
    RayLists lists;
    std::mt19937 random(7);
    const auto uniform = [&] { return double(random()) / 4294967296.0; };
    const glm::dvec3 light = (kLightPosition - frame.origin) / frame.voxel_edge;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i].met) continue;
        lists.hitting.push_back(rays[i]);
        const glm::dvec3 back = -glm::normalize(rays[i].direction);
        const glm::dvec3 start = hits[i].at + back * 2.0;
        lists.shadow.push_back({start, light - start});
        const double radius = std::sqrt(uniform()), angle = 6.283185307179586 * uniform();
        const glm::dvec3 side = glm::normalize(glm::cross(back, glm::dvec3(0.3, 1, 0.2)));
        const glm::dvec3 other = glm::cross(back, side);
        lists.bounce.push_back({start, back * std::sqrt(1 - radius * radius) +
                                           side * (radius * std::cos(angle)) +
                                           other * (radius * std::sin(angle))});
    }
    return lists;
}

Mesh scaled_mesh(const char* path) {
    Mesh mesh = read_mesh(path);
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
    const glm::vec3 extent = high - low;
    const float scale = 1 / std::max({extent.x, extent.y, extent.z});
    for (glm::vec3& p : mesh.positions) p = (p - 0.5f * (low + high)) * scale;
    return mesh;
}

Mesh halved(const Mesh& mesh) {
    Mesh result;
    result.positions = mesh.positions;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [at, is_new] =
            middles.emplace(std::minmax(a, b), uint32_t(result.positions.size()));
        if (is_new) result.positions.push_back(0.5f * (mesh.positions[a] + mesh.positions[b]));
        return at->second;
    };
    for (const glm::uvec3& t : mesh.triangles) {
        const uint32_t xy = middle(t.x, t.y), yz = middle(t.y, t.z), zx = middle(t.z, t.x);
        result.triangles.insert(result.triangles.end(),
                                {{t.x, xy, zx}, {xy, t.y, yz}, {zx, yz, t.z}, {xy, yz, zx}});
    }
    return result;
}

}  // namespace voxelume
