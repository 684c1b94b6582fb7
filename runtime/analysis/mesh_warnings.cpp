// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/mesh_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/text.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

bool needs_inside(const Scene& scene, const Object& object) {
    const Model& model = scene.models[size_t(object.model)];
    return stores_distances(model.surface) || transmits(scene, object) ||
           (shows_voxels(model.surface) && model.set == VoxelSet::solid);
}

void add_topology_warnings(const Model& model, const MeshSummary& mesh,
                           std::vector<Warning>& warnings) {
    const std::string file = quote(model.mesh.filename().string());
    if (is_open(mesh)) {
        add_once({WarningKind::open_mesh, model.where,
                  fmt::format("{} is open along {} edges, and its surface needs an inside: close "
                              "its holes, or give the model \"surface\": \"exact\"{}",
                              file, mesh.topology.open_edges,
                              lists_primitives(model.surface) ? " and an opaque material" : "")},
                 warnings);
    } else if (mesh.topology.volume < 0) {
        add_once({WarningKind::inside_out_mesh, model.where,
                  fmt::format("{} is inside out: its faces turn inwards, so nothing of it is "
                              "inside; turn them in the program that made it",
                              file)},
                 warnings);
    }
}

/// What of the material library is missed; empty if nothing is.
std::string missed_materials(const Object& object, const MeshSummary& mesh) {
    const std::string library = quote(mesh.material_library);
    if (mesh.group_names.size() > 1)
        return fmt::format("the {} materials of {} aren't read", mesh.group_names.size(), library);
    return object.material == 0 ? fmt::format("{} isn't read", library) : "";
}

void add_material_warning(const Object& object, const Model& model, const MeshSummary& mesh,
                          std::vector<Warning>& warnings) {
    const std::string file = quote(model.mesh.filename().string());
    for (const std::string& note : mesh.notes)
        add_once({WarningKind::ignored_materials, object.where, fmt::format("{}: {}", file, note)},
                 warnings);
    std::string missed;
    if (!mesh.material_library.empty() && object.groups.empty())
        missed = missed_materials(object, mesh);
    if (missed.empty()) return;
    const std::string advice = mesh.group_names.size() > 1
                                   ? fmt::format("give the object \"materials\", like {{{}: NAME}}",
                                                 quote(mesh.group_names.front()))
                                   : "give the object a \"material\" of the scene";
    add_once({WarningKind::ignored_materials, object.where,
              fmt::format("{}: {}; {}", file, missed, advice)},
             warnings);
}

/// What of the textures a surface doesn't show; empty if it shows all.
std::string missed_of_textures(const MeshPaint& paint, Surface surface) {
    const bool is_cubes = shows_voxels(surface);
    const bool maps = is_cubes && paint.mapped > 0,
               alpha = surface != Surface::exact && paint.has_alpha;
    if (maps && alpha) return "the alpha, roughness, metalness and emission of its textures aren't";
    if (maps) return "the roughness, metalness and emission of its textures aren't";
    return alpha ? "the alpha of its textures isn't" : "";
}

void add_texture_warning(const Model& model, const MeshPaint& paint,
                         std::vector<Warning>& warnings) {
    const std::string missed = missed_of_textures(paint, model.surface);
    if (missed.empty()) return;
    const bool wants_exact = paint.has_alpha;
    add_once(
        {WarningKind::ignored_materials, model.where,
         fmt::format("{}: {} shown on \"{}\": give the model \"surface\": {}",
                     quote(model.mesh.filename().string()), missed, kind_of(model.surface).name,
                     wants_exact ? "\"exact\"" : "\"smooth\" or \"exact\"")},
        warnings);
}

}  // namespace

void add_mesh_warnings(const Scene& scene, const Object& object, AssetStore& meshes,
                       std::vector<Warning>& warnings) {
    const Model& model = scene.models[size_t(object.model)];
    if (!object.visible || model.mesh.empty()) return;
    const MeshSummary& mesh = *meshes.summary_of(model);
    if (needs_inside(scene, object)) add_topology_warnings(model, mesh, warnings);
    add_material_warning(object, model, mesh, warnings);
    add_texture_warning(model, mesh.paint, warnings);
}

}  // namespace voxelume
