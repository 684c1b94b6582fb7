// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/shape/mesh_shape.hpp"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/geometry/shape/edge_turns.hpp"

namespace voxelume {
namespace {

const char* closed_words(const MeshSummary& mesh) {
    return mesh.topology.open_edges > 0 ? "closed but for small holes" : "closed";
}

double enough_creases(double area) {
    return kSharpShare * std::sqrt(area);
}

double area_of(const Mesh& mesh) {
    double sum = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        sum += glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return sum;
}

/// "1 voxel", "0.25 voxels".
std::string voxels_text(double count) {
    const std::string number = fmt::format("{:.2g}", count);
    return number + (number == "1" ? " voxel" : " voxels");
}

bool is_sharp(const MeshSummary& mesh, const MeshShape& shape) {
    return shape.creases.length > enough_creases(mesh.area.total);
}

}  // namespace

MeshShape shape_of(const Mesh& mesh) {
    return {creases_of(mesh, enough_creases(area_of(mesh))), thickness_of(mesh)};
}

MeshShape scaled(const MeshShape& shape, double scale) {
    return {{scale * shape.creases.length, scale * shape.creases.round_width,
             scale * shape.creases.round_length},
            scaled(shape.thickness, scale)};
}

bool has_sharp_edges(const MeshSummary& mesh, const MeshShape& shape, double voxel_edge) {
    return is_sharp(mesh, shape) || shape.creases.round_width <= voxel_edge;
}

SurfaceChoice surface_for(const MeshSummary& mesh, const MeshShape& shape, double voxel_edge) {
    if (!has_area(mesh)) return {Surface::cubes, "it has points and lines alone"};
    if (is_open(mesh))
        return {Surface::exact, fmt::format("it is open at {} edges", mesh.topology.open_edges)};
    if (!(mesh.topology.volume > 0))
        return {Surface::exact, "it has no volume, or its faces look inwards"};
    if (is_sharp(mesh, shape))
        return {Surface::exact, fmt::format("it has {:.3g} m of edges that turn by {} degrees or "
                                            "more",
                                            shape.creases.length, kSharpAngle)};
    if (has_sharp_edges(mesh, shape, voxel_edge))
        return {Surface::exact, fmt::format("it has {:.3g} m of edges that turn by {} degrees or "
                                            "more within a voxel",
                                            shape.creases.round_length, kSharpAngle)};
    // A distance field has the facets of the triangles, which such normals are made to hide.
    if (mesh.has_normals) return {Surface::exact, "its file has normals"};
    const double thickness = shape.thickness.body / voxel_edge,
                 part = shape.thickness.part / voxel_edge;
    if (thickness < kThinVoxels || part < kThinPartVoxels)
        return {Surface::exact,
                fmt::format("parts of it are only {} thick",
                            voxels_text(thickness < kThinVoxels ? thickness : part)),
                true};
    return {Surface::smooth,
            fmt::format("it is {}, without sharp edges, and {:.3g} voxels thick",
                        closed_words(mesh), thickness),
            shape.thickness.hint < kThinVoxels * voxel_edge};
}

std::string refusal_of_parts(const MeshSummary& mesh) {
    if (mesh.paint.is_there()) return "it has colours or textures";
    return mesh.group_names.size() > 1 ? "it has groups" : "";
}

SurfaceChoice surface_with(const SurfaceChoice& choice, const MeshSummary& mesh,
                           const MeshSummary& part, const std::string& refusal) {
    const double share = part.triangles > 0 ? part.area.total / mesh.area.total : 0;
    if (share == 0) return {choice.surface, choice.reason};
    const std::string thin = fmt::format(
        "{} % of it lies around parts thinner than {} voxels",
        share < 0.1 ? fmt::format("{:.2g}", 100 * share) : fmt::format("{:.0f}", 100 * share),
        kThinVoxels);
    if (share > kMaxThinShare) return {Surface::exact, thin};
    if (!refusal.empty()) return {Surface::exact, fmt::format("{}, and {}", thin, refusal)};
    return {
        Surface::smooth,
        fmt::format("it is {} and without sharp edges; {}, and is exact", closed_words(mesh), thin),
        true};
}

}  // namespace voxelume
