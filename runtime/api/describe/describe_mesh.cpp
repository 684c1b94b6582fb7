// SPDX-License-Identifier: Apache-2.0
// What is in a mesh file.
#include "runtime/api/describe/describe.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "runtime/analysis/warnings/mesh_warnings.hpp"
#include "runtime/geometry/mesh_points.hpp"
#include "runtime/geometry/shape/mesh_shape.hpp"
#include "runtime/io/gltf/gltf_animation.hpp"
#include "runtime/io/gltf/gltf_mesh.hpp"
#include "runtime/io/gltf/gltf_unshown.hpp"
#include "runtime/io/mesh/material_library.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/memory/plan.hpp"

namespace voxelume::api {
namespace {

/// The voxels and the memory of the mesh as a smooth model at this resolution, and the surface that
/// suits it.
Report at_resolution(const std::filesystem::path& path, const Mesh& mesh,
                     const MeshSummary& summary, const MeshShape& shape, int resolution) {
    Model model;
    model.mesh = path;
    model.where = path.string();
    model.resolution = resolution;
    const GridPlan plan = plan_model(model, mesh);
    const glm::ivec3 size = plan.frame.size - 2 * kModelMargin;
    const double edge = plan.frame.voxel_edge.x;
    SurfaceChoice choice = surface_for(summary, shape, edge);
    if (choice.may_be_thin)
        choice = surface_with(choice, summary, summary_of(thin_part_of(mesh, edge).mesh),
                              refusal_of_parts(summary));
    return {{"resolution", resolution},
            {"voxel edge", plan.frame.voxel_edge.x},
            {"voxels", fmt::format("{}x{}x{}", size.x, size.y, size.z)},
            {"surface voxels, about", uint64_t(std::llround(plan.voxels))},
            {"MB smooth, about", std::stod(fmt::format("{:.3g}", plan.kept_bytes / 1e6))},
            {"surface", kind_of(choice.surface).name},
            {"because", choice.reason}};
}

/// The clips of a glTF file, and how many nodes each moves.
Report clips_in(const GltfFile& file) {
    Report clips = Report::array();
    for (size_t number = 0; number < file.root().size("animations"); ++number) {
        const GltfClip clip = gltf_clip(file, number);
        std::set<int> nodes;
        for (const GltfTrack& track : clip.tracks) nodes.insert(track.node);
        clips.push_back({{"name", clip.name}, {"seconds", clip.seconds}, {"nodes", nodes.size()}});
    }
    return clips;
}

/// Notes on textures in the libraries of an OBJ file that no surface shows. Nearly every file has
/// some, so rendering doesn't warn of them.
std::vector<std::string> unshown_maps(const std::filesystem::path& path, const Mesh& mesh) {
    bool has_bumps = false, has_specular = false;
    std::vector<std::string> faults;  // the mesh's summary has them, too
    for (const MtlMaterial& m : read_material_libraries(path, mesh.material_libraries, faults)) {
        has_bumps |= m.has_bumps;
        has_specular |= m.has_specular_maps;
    }
    std::vector<std::string> notes;
    if (has_bumps)
        notes.emplace_back(
            "its textures map_Bump, norm and disp aren't shown: surfaces have no bumps");
    if (has_specular)
        notes.emplace_back(
            "its textures map_Ks and map_Ns aren't shown: all of a surface has one highlight");
    return notes;
}

/// Notes on what isn't shown of the file.
std::vector<std::string> notes_of(const MeshSummary& mesh, std::vector<std::string> notes) {
    notes.insert(notes.begin(), mesh.notes.begin(), mesh.notes.end());
    notes.insert(notes.end(), mesh.library_faults.begin(), mesh.library_faults.end());
    if (mesh.library_faults.empty() && !mesh.missing_materials.empty())
        notes.push_back(missing_materials_sentence(mesh.missing_materials, mesh));
    return notes;
}

/// Adds the sizes of the mesh's pictures, and whose alpha counts.
void add_textures(const Mesh& mesh, Report& report) {
    for (const Texture& texture : mesh.textures) {
        if (!texture.is_of_vertices)
            report["textures"].push_back({texture.image->width, texture.image->height});
        if (texture.alpha != kAlphaOpaque)
            report[texture.is_of_vertices ? "vertex alpha" : "texture alpha"] =
                "only \"exact\" surfaces show it";
    }
}

}  // namespace

Report describe_mesh(const std::filesystem::path& path) {
    Report clips = Report::array();
    std::vector<std::string> unshown;
    Mesh mesh;
    if (is_gltf_file(path)) {
        const GltfFile file(read_mesh_bytes(path), path);
        mesh = gltf_mesh(file, 0);
        clips = clips_in(file);
        unshown = unshown_of_gltf(file);
    } else {
        mesh = read_mesh(path);
        unshown = unshown_maps(path, mesh);
    }
    const MeshSummary summary = summary_of(mesh);
    const Bounds& box = summary.surface;
    const uint64_t open = summary.topology.open_edges;
    const MeshShape shape = shape_of(mesh);
    Report report = {{"kind", "triangle mesh"},
                     {"triangles", mesh.triangles.size()},
                     {"vertices", mesh.positions.size()},
                     {"vertex colors", !mesh.vertex_colors.empty()},
                     {"groups", mesh.group_names},
                     {"closed", open == 0},
                     {"open edges", open},
                     {"sharp edges, m", shape.creases.length},
                     {"thickness, m", shape.thickness.body},
                     {"thickness of thin parts, m", shape.thickness.part}};
    report["min"] = {box.min.x, box.min.y, box.min.z};
    report["max"] = {box.max.x, box.max.y, box.max.z};
    if (const PointCounts counts = count_points(mesh); counts.points + counts.lines > 0) {
        report["points"] = counts.points;
        report["lines"] = counts.lines;
    }
    if (!mesh.triangle_colors.empty()) report["face colors"] = true;
    add_textures(mesh, report);
    if (summary.paint.mapped > 0)
        report["texture maps"] = "roughness, metalness or emission, which \"cubes\" don't show";
    if (!clips.empty()) report["clips"] = clips;
    unshown.insert(unshown.end(), mesh.assumptions.begin(), mesh.assumptions.end());
    const std::vector<std::string> notes = notes_of(summary, std::move(unshown));
    if (!notes.empty()) report["notes"] = notes;
    if (box.min == box.max) return report;
    report["as voxels"] = Report::array();
    for (const int resolution : {128, 256, 512, 1024})
        report["as voxels"].push_back(at_resolution(path, mesh, summary, shape, resolution));
    return report;
}

}  // namespace voxelume::api
