// SPDX-License-Identifier: Apache-2.0
// What is in a mesh file.
#include "runtime/api/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "runtime/base/error.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/memory/plan.hpp"

namespace voxelume::api {
namespace {

using Point = std::array<float, 3>;

/// For each position the number of the first one at the same place.
std::vector<uint32_t> places(const Mesh& mesh) {
    std::vector<uint32_t> order(mesh.positions.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto point = [&](uint32_t i) {
        const glm::vec3 p = mesh.positions[i] + 0.0f;  // -0 is 0
        return Point{p.x, p.y, p.z};
    };
    std::ranges::sort(order, {}, point);
    std::vector<uint32_t> place(order.size());
    for (size_t i = 0; i < order.size(); ++i)
        place[order[i]] =
            i > 0 && point(order[i]) == point(order[i - 1]) ? place[order[i - 1]] : order[i];
    return place;
}

/// Edges that aren't run along as often in one direction as in the other: 0 for a closed mesh.
uint64_t open_edges(const Mesh& mesh) {
    const std::vector<uint32_t> place = places(mesh);
    struct Edge {
        uint32_t low, high;
        int direction;
    };
    std::vector<Edge> edges;
    edges.reserve(mesh.triangles.size() * 3);
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            const uint32_t a = place[triangle[corner]], b = place[triangle[(corner + 1) % 3]];
            if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
        }
    }
    const auto ends = [](const Edge& edge) { return std::pair(edge.low, edge.high); };
    std::ranges::sort(edges, {}, ends);
    uint64_t open = 0;
    for (size_t i = 0; i < edges.size();) {
        const auto here = ends(edges[i]);
        int sum = 0;
        for (; i < edges.size() && ends(edges[i]) == here; ++i) sum += edges[i].direction;
        open += uint64_t(std::abs(sum));
    }
    return open;
}

/// What the mesh becomes as a smooth model.
Report at_resolution(const std::filesystem::path& path, const Mesh& mesh, int resolution) {
    Model model;
    model.mesh = path;
    model.where = path.string();
    model.resolution = resolution;
    const GridPlan plan = plan_model(model, mesh);
    const glm::ivec3 size = plan.frame.size - 2 * kModelMargin;
    return {{"resolution", resolution},
            {"voxel edge", plan.frame.voxel_edge.x},
            {"voxels", fmt::format("{}x{}x{}", size.x, size.y, size.z)},
            {"surface voxels, about", uint64_t(std::llround(plan.voxels))},
            {"MB smooth, about", std::stod(fmt::format("{:.3g}", plan.kept_bytes / 1e6))}};
}

}  // namespace

Report describe_mesh(const std::filesystem::path& path) {
    const Mesh mesh = read_mesh(path);
    const Bounds box = mesh_bounds(mesh);
    const uint64_t open = open_edges(mesh);
    Report report = {{"kind", "triangle mesh"},
                     {"triangles", mesh.triangles.size()},
                     {"vertices", mesh.positions.size()},
                     {"vertex colors", !mesh.vertex_colors.empty()},
                     {"groups", mesh.group_names},
                     {"closed", open == 0},
                     {"open edges", open}};
    report["min"] = {box.min.x, box.min.y, box.min.z};
    report["max"] = {box.max.x, box.max.y, box.max.z};
    if (box.min == box.max) return report;
    report["as voxels"] = Report::array();
    for (const int resolution : {128, 256, 512, 1024})
        report["as voxels"].push_back(at_resolution(path, mesh, resolution));
    return report;
}

}  // namespace voxelume::api
