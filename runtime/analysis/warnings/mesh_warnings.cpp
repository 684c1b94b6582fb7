// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/warnings/mesh_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

#include "runtime/base/text.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

constexpr size_t kMaxNotes = 8;  // warnings of one file

/// The mesh's file, in quotes. Files of one name in different folders are told apart.
std::string file_of(const Scene& scene, const Model& model) {
    const std::filesystem::path name = model.mesh.filename();
    const bool is_one = std::ranges::all_of(scene.models, [&](const Model& other) {
        return other.mesh == model.mesh || other.mesh.filename() != name;
    });
    if (is_one) return quote(name.string());
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::absolute(scene.file, error).parent_path();
    const std::filesystem::path below = std::filesystem::relative(model.mesh, folder, error);
    const bool leads_out = error || below.empty() || *below.begin() == "..";
    return quote((leads_out ? model.mesh : below).string());
}

bool needs_inside(const Scene& scene, const Object& object) {
    const Model& model = scene.models[size_t(object.model)];
    return stores_distances(model.surface) || transmits(scene, object) ||
           (shows_voxels(model.surface) && model.set == VoxelSet::solid);
}

void add_topology_warnings(const Scene& scene, const Model& model, const MeshSummary& mesh,
                           std::vector<Warning>& warnings) {
    if (is_open(mesh)) {
        add_once({WarningKind::open_mesh, model.where,
                  fmt::format("{} is open along {} edges, and its surface needs an inside: close "
                              "its holes, or give the model \"surface\": \"exact\"{}",
                              file_of(scene, model), mesh.topology.open_edges,
                              lists_primitives(model.surface) ? " and an opaque material" : "")},
                 warnings);
    } else if (mesh.topology.volume < 0) {
        add_once({WarningKind::inside_out_mesh, model.where,
                  fmt::format("{} is inside out: its faces turn inwards, so nothing of it is "
                              "inside; turn them in the program that made it",
                              file_of(scene, model))},
                 warnings);
    }
}

/// The names of the libraries, in quotes.
std::string libraries_of(const MeshSummary& mesh) {
    std::vector<std::string> quoted;
    quoted.reserve(mesh.material_libraries.size());
    for (const std::string& name : mesh.material_libraries) quoted.push_back(quote(name));
    return fmt::format("{}", fmt::join(quoted, " and "));
}

/// The groups whose materials the file lacks, and to which the scene gives none either.
std::vector<std::string> missing_materials(const Object& object, const MeshSummary& mesh) {
    if (object.material != 0) return {};
    std::vector<std::string> missing;
    for (const std::string& name : mesh.missing_materials) {
        const bool is_given =
            std::ranges::find(object.groups, name, &GroupMaterial::group) != object.groups.end();
        if (!is_given) missing.push_back(name);
    }
    return missing;
}

/// A clause on what is missing from the material library; empty if nothing is.
std::string missed_materials(const Object& object, const MeshSummary& mesh) {
    const std::vector<std::string> missing = missing_materials(object, mesh);
    if (!missing.empty()) return missing_materials_sentence(missing, mesh);
    if (mesh.material_libraries.empty() || !object.groups.empty()) return "";
    const std::string library = libraries_of(mesh);
    if (mesh.group_names.size() > 1)
        return fmt::format("the {} materials of {} aren't read", mesh.group_names.size(), library);
    const char* const verb = mesh.material_libraries.size() > 1 ? "aren't" : "isn't";
    return object.material == 0 ? fmt::format("{} {} read", library, verb) : "";
}

/// A clause on the fault of each library.
std::string faults_of_libraries(const std::vector<std::string>& faults) {
    const std::span<const std::string> shown(faults.data(), std::min(faults.size(), kMaxNotes));
    if (faults.size() == shown.size() && shown.size() > 1)
        return fmt::format("{}, and {}", fmt::join(shown.first(shown.size() - 1), ", "),
                           shown.back());
    std::string text = fmt::format("{}", fmt::join(shown, ", "));
    if (faults.size() > shown.size())
        text +=
            fmt::format(", and {} more of its libraries aren't read", faults.size() - shown.size());
    return text;
}

/// Advice on missing materials.
std::string material_advice(const Object& object, const MeshSummary& mesh) {
    if (mesh.group_names.size() < 2) return "give the object a \"material\" of the scene";
    const std::vector<std::string> missing = missing_materials(object, mesh);
    return fmt::format("give the object \"materials\", like {{{}: NAME}}",
                       quote(missing.empty() ? mesh.group_names.front() : missing.front()));
}

/// An object, and its file that warnings are about.
struct ShownFile {
    const Scene& scene;
    const Object& object;
    const Model& model;
    const MeshSummary& mesh;
};

/// Adds a warning about a file, at the first object that shows the file. Names in files may be of
/// any length.
void add_note(const ShownFile& of, const std::string& sentence, std::vector<Warning>& warnings) {
    constexpr size_t kMaxLength = 600;
    std::string text = fmt::format("{}: {}", file_of(of.scene, of.model), sentence);
    if (text.size() > kMaxLength) text = text.substr(0, kMaxLength) + "...";
    const std::string file = of.model.mesh.string();
    const bool is_known = std::ranges::any_of(warnings, [&](const Warning& warning) {
        return warning.kind == WarningKind::ignored_materials && warning.file == file &&
               warning.text == text;
    });
    if (!is_known)
        warnings.push_back({WarningKind::ignored_materials, of.object.where, text, file});
}

void add_material_warning(const ShownFile& of, std::vector<Warning>& warnings) {
    const std::vector<std::string>& notes = of.mesh.notes;
    const size_t shown = std::min(notes.size(), kMaxNotes);
    for (size_t i = 0; i < shown; ++i) add_note(of, notes[i], warnings);
    if (notes.size() > shown)
        add_note(of,
                 fmt::format("{} more of what it has isn't shown; `voxelume info` lists it",
                             notes.size() - shown),
                 warnings);
    const std::string missed = missed_materials(of.object, of.mesh);
    if (missed.empty()) return;
    add_note(of, fmt::format("{}; {}", missed, material_advice(of.object, of.mesh)), warnings);
}

/// A clause on what a surface doesn't show of the textures; empty if it shows all.
std::string missed_of_textures(const MeshPaint& paint, Surface surface) {
    const bool is_cubes = shows_voxels(surface);
    const bool maps = is_cubes && paint.mapped > 0,
               alpha = !lists_primitives(surface) && paint.has_alpha;
    if (maps && alpha) return "the alpha, roughness, metalness and emission of its textures aren't";
    if (maps) return "the roughness, metalness and emission of its textures aren't";
    return alpha ? "its alpha isn't" : "";
}

void add_texture_warning(const Scene& scene, const Model& model, const MeshPaint& paint,
                         std::vector<Warning>& warnings) {
    const std::string missed = missed_of_textures(paint, model.surface);
    if (missed.empty()) return;
    const bool wants_exact = paint.has_alpha;
    add_once({WarningKind::ignored_materials, model.where,
              fmt::format("{}: {} shown on \"{}\": give the model \"surface\": {}",
                          file_of(scene, model), missed, kind_of(model.surface).name,
                          wants_exact ? "\"exact\"" : "\"smooth\" or \"exact\"")},
             warnings);
}

}  // namespace

std::string missing_materials_sentence(const std::vector<std::string>& missing,
                                       const MeshSummary& mesh) {
    if (!mesh.library_faults.empty()) return faults_of_libraries(mesh.library_faults);
    const bool is_one = missing.size() == 1;
    const std::string its =
        is_one ? fmt::format("its material {}", quote(missing[0]))
               : fmt::format("{} of its materials, like {},", missing.size(), quote(missing[0]));
    if (mesh.material_libraries.empty()) return fmt::format("it names no library that has {}", its);
    return fmt::format("{} {} in {}", its, is_one ? "isn't" : "aren't", libraries_of(mesh));
}

void add_mesh_warnings(const Scene& scene, const Object& object, AssetStore& meshes,
                       std::vector<Warning>& warnings) {
    const Model& model = scene.models[size_t(object.model)];
    if (!object.visible || model.mesh.empty()) return;
    const MeshSummary& mesh = *meshes.summary_of(model);
    if (needs_inside(scene, object)) add_topology_warnings(scene, model, mesh, warnings);
    add_material_warning({scene, object, model, mesh}, warnings);
    add_texture_warning(scene, model, mesh.paint, warnings);
}

}  // namespace voxelume
