// SPDX-License-Identifier: Apache-2.0
// glTF file -> contents of a scene: a model for each mesh that is used, an object for each node
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>

#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/import/contents.hpp"
#include "runtime/import/gltf_morphs.hpp"
#include "runtime/import/gltf_sight.hpp"
#include "runtime/import/gltf_tracks.hpp"
#include "runtime/import/gltf_values.hpp"
#include "runtime/io/gltf/gltf_mesh.hpp"
#include "runtime/io/gltf/gltf_nodes.hpp"
#include "runtime/io/gltf/gltf_primitives.hpp"
#include "runtime/io/gltf/gltf_texture_use.hpp"

namespace voxelume {
namespace {

/// True unless the map flattens some axis: a flat node can't be placed.
bool can_be_placed(const glm::dmat4& map) {
    double shortest = INFINITY, longest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        shortest = std::min(shortest, glm::length(glm::dvec3(map[axis])));
        longest = std::max(longest, glm::length(glm::dvec3(map[axis])));
    }
    const double volume = std::abs(glm::determinant(glm::dmat3(map)));
    return std::isfinite(longest) && shortest > 1e-4 * longest &&
           volume > 1e-9 * longest * longest * longest;
}

/// The clip that the options choose; an empty one where the file has none.
GltfClip clip_of(const GltfFile& gltf, const std::string& wanted) {
    const std::vector<std::string> names = gltf_clip_names(gltf);
    if (wanted.empty()) return names.empty() ? GltfClip{} : gltf_clip(gltf, 0);
    const auto found = std::ranges::find(names, wanted);
    if (found != names.end()) return gltf_clip(gltf, size_t(found - names.begin()));
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw Error(ErrorKind::usage, "{}: has no clip {}{}", SourcePlace(gltf.path().string()),
                quote(wanted), known.empty() ? "; nothing in it moves" : suggest(wanted, known));
}

/// A model, which is written when all objects that show it are known.
struct MeshModel {
    std::string name, surface;  ///< the latter as members
    int number = 0;             ///< number of the mesh in the file
    double stretch = 0;         ///< largest scale of its points or of what moves; 0: none
    GltfMorph morph;
};

class SceneOfGltf {
  public:
    SceneOfGltf(const ImportedFile& file, const glm::dmat4& world_from_file)
        : file_(file),
          gltf_(file.assets.gltf_file(file.path)),
          root_(gltf_.root()),
          clip_(clip_of(gltf_, file.options.clip)),
          motion_(gltf_, clip_, world_from_file),
          unlit_(gltf_unlit_materials(gltf_)),
          frames_{motion_, clip_.tracks.empty() ? 1 : frame_count(clip_.seconds)} {
        for (size_t i = 0; i < gltf_.material_names().size(); ++i)
            material_numbers_.emplace(gltf_.material_names()[i], i);
    }

    Contents read() {
        contents_.box = {glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
        std::vector<GltfNode> nodes = gltf_nodes(gltf_);
        for (GltfNode& node : nodes) {
            node.world_from_node = motion_.moves(node.number)
                                       ? frames_.map_at(node, 1)
                                       : motion_.world_from_file() * node.world_from_node;
            if (node.mesh >= 0) add_object(node);
        }
        if (contents_.objects.empty() || !(longest_side(contents_.box) > 0))
            throw Error(ErrorKind::input, "{}: has no triangles, points or lines to show",
                        SourcePlace(file_.path.string()));
        contents_.voxel_size = mesh_voxel_size(contents_.box, has_textures_);
        if (!has_area_)
            contents_.voxel_size =
                point_voxel_size(file_.assets.mesh(file_.path), contents_, frames_.scale());
        contents_.materials.insert(contents_.materials.begin(),
                                   fmt::format("\"default\": {{\"color\": {}, \"specular\": 0.1}}",
                                               has_colors_ ? "[1, 1, 1]" : "[0.72, 0.7, 0.68]"));
        for (const MeshModel& model : models_) contents_.models.push_back(model_text(model));
        contents_.observer =
            gltf_observer(gltf_, nodes, contents_.box, file_.options.size, frames_);
        contents_.lights = gltf_light_items(gltf_, nodes, contents_.box, frames_, contents_.tracks);
        if (file_.options.has_own_camera && !file_.options.is_lattice)
            add_observer_tracks(gltf_, nodes, frames_, contents_.tracks);
        if (!contents_.tracks.empty()) contents_.frames = frames_.count;
        contents_.fps = kGltfFrameRate;
        contents_.max_locally_emissive = kEmissiveLightSamples;  // each has one
        return std::move(contents_);
    }

  private:
    void add_object(const GltfNode& node) {
        const GltfValue mesh = root_.item("meshes", size_t(node.mesh));
        if (!draws(node.mesh)) return;
        // Its joints alone place a mesh that has a skin.
        const bool is_skinned = node.skin >= 0;
        std::vector<glm::dmat4> maps =
            is_skinned ? std::vector{motion_.world_from_file()} : frames_.maps_of(node);
        std::erase_if(maps, [](const glm::dmat4& map) { return !can_be_placed(map); });
        if (maps.empty()) return;
        Model model;
        model.mesh = file_.path;
        model.part = node.mesh + 1;
        const MeshSummary& summary = *file_.assets.summary_of(model);
        has_textures_ |= summary.paint.textures > 0;
        has_colors_ |= summary.paint.is_there();
        has_area_ |= has_area(summary);
        const std::string wanted = node.name.empty() ? mesh.text("name") : node.name;
        const std::string name = objects_.unique(wanted.empty() ? "object" : wanted);
        MeshModel& shown = model_of(node, mesh, summary);
        const std::string place =
            is_skinned ? matrix_member(motion_.world_from_file()) : place_text(node, name);
        contents_.objects.push_back(fmt::format(
            "{{\"name\": {}, \"model\": {}{}{}{}}}", json_text(name), json_text(shown.name),
            materials_member(summary), spots_member(summary), place));
        if (shines(summary)) contents_.emissive_objects.push_back(contents_.objects.size() - 1);
        const Bounds box = reach_of(shown.morph, gltf_, node.mesh, summary.surface, frames_.count);
        for (const glm::dmat4& map : maps) {
            add_box(map, box);
            if (!is_skinned && (motion_.moves(node.number) || !has_area(summary)))
                shown.stretch = std::max(shown.stretch, stretch_of(glm::dmat3(map)).max);
        }
    }

    /// True if a mesh has something to draw; each mesh is asked once.
    bool draws(int mesh) {
        const auto [known, is_new] = drawn_.try_emplace(mesh, false);
        if (is_new) known->second = !gltf_primitives(root_.item("meshes", size_t(mesh))).empty();
        return known->second;
    }

    /// The keys that place the object. Its tracks are added to the contents.
    std::string place_text(const GltfNode& node, const std::string& name) {
        if (motion_.moves(node.number)) {
            GltfPlace place = gltf_place(motion_, node, name);
            for (std::string& track : place.tracks) contents_.tracks.push_back(std::move(track));
            return place.members;
        }
        return matrix_member(node.world_from_node);
    }

    static std::string matrix_member(const glm::dmat4& map) {
        if (map == glm::dmat4(1)) return {};
        return fmt::format(",\n     \"matrix\": {}", matrix_text(map));
    }

    void add_box(const glm::dmat4& map, const Bounds& box) {
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 p(map * glm::dvec4(corner(box, i), 1));
            contents_.box = {glm::min(contents_.box.min, p), glm::max(contents_.box.max, p)};
        }
    }

    /// The model of the node's mesh, which nodes with weights of their own don't share.
    MeshModel& model_of(const GltfNode& node, const GltfValue& mesh, const MeshSummary& summary) {
        GltfMorph morph = gltf_morph(gltf_, clip_, node);
        const std::array key = {node.mesh, morph.owner, morph.skin};
        const auto [entry, is_new] = model_numbers_.try_emplace(key, models_.size());
        if (!is_new) return models_[entry->second];
        const std::string wanted = mesh.text("name");
        const std::string name =
            model_names_.unique(wanted.empty() ? fmt::format("mesh {}", node.mesh + 1) : wanted);
        if (morph.keys)
            contents_.tracks.push_back(
                keys_track(fmt::format("models.{}.morph.weights", target_name(name)), *morph.keys));
        if (!morph.clip.empty() && clip_.seconds > 0)
            contents_.tracks.push_back(skin_track(name, clip_.seconds));
        models_.push_back({name, surface_members(summary, false), node.mesh, 0, std::move(morph)});
        return models_.back();
    }

    /// The model as text. What moves keeps voxels of its own, and so do cubes; their voxels are to
    /// be as large as the world's.
    std::string model_text(const MeshModel& model) const {
        const std::string voxels =
            model.stretch > 0 ? fmt::format(", \"voxel_size\": {}",
                                            rounded(contents_.voxel_size.x / model.stretch, 4))
                              : "";
        return fmt::format("{}: {{\"mesh\": {}, \"part\": {}, {}{}{}}}", json_text(model.name),
                           json_text(file_.name), model.number + 1, model.surface,
                           morph_member(model.morph), voxels);
    }

    /// The materials of an object's groups, each of which is written once.
    std::string materials_member(const MeshSummary& summary) {
        std::vector<std::string> members;
        for (const std::string& group : summary.group_names) {
            if (group.empty()) continue;
            const auto [entry, is_new] = materials_.try_emplace(group);
            if (is_new) entry->second = add_material(group);
            members.push_back(fmt::format("{}: {}", json_text(group), json_text(entry->second)));
        }
        if (members.empty()) return {};
        return fmt::format(", \"materials\": {{{}}}", fmt::join(members, ", "));
    }

    bool is_unlit(const std::string& group) const {
        const auto found = material_numbers_.find(group);
        return found != material_numbers_.end() && unlit_.contains(int(found->second));
    }

    /// True for a mesh some of whose materials emit light.
    bool shines(const MeshSummary& summary) const {
        return std::ranges::any_of(summary.group_names, [&](const std::string& group) {
            const auto number = material_numbers_.find(group);
            return number != material_numbers_.end() && !is_unlit(group) &&
                   gltf_shines(root_.item("materials", number->second));
        });
    }

    /// The object's number of light samples as text. Unlit surfaces light nothing, unless they
    /// belong to one object with emissive ones.
    std::string spots_member(const MeshSummary& summary) const {
        if (shines(summary)) return {};
        const bool has_unlit =
            std::ranges::any_of(summary.group_names, [&](const std::string& group) {
                return is_unlit(group) &&
                       gltf_has_color(root_.item("materials", material_numbers_.at(group)));
            });
        return has_unlit ? ", \"spots\": 0" : "";
    }

    std::string add_material(const std::string& group) {
        std::string name = material_names_.unique(group);
        const GltfValue material = root_.item("materials", material_numbers_.at(group));
        contents_.has_glass |= gltf_transmits(material) && !is_unlit(group);
        contents_.materials.push_back(
            fmt::format("{}: {{{}}}", json_text(name),
                        gltf_values(material, is_unlit(group), frames_.scale())));
        return name;
    }

    const ImportedFile& file_;
    const GltfFile& gltf_;
    GltfValue root_;
    GltfClip clip_;
    GltfMotion motion_;
    std::set<int> unlit_;        ///< materials
    std::map<int, bool> drawn_;  ///< by mesh: see draws()
    GltfFrames frames_;
    Contents contents_;
    std::map<std::array<int, 3>, size_t> model_numbers_;  ///< by mesh, owner of weights, skin
    std::vector<MeshModel> models_;                       ///< in the order of their first objects
    std::map<std::string, size_t> material_numbers_;      ///< by group
    std::map<std::string, std::string> materials_;        ///< by group
    NameList objects_{{"ground"}}, model_names_{{"ground"}};
    NameList material_names_{{"default", "ground"}};
    bool has_textures_ = false, has_colors_ = false, has_area_ = false;
};

}  // namespace

Contents gltf_contents(const ImportedFile& file) {
    // Z becomes Y, and Y becomes -Z.
    const glm::dmat4 z_up(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1);
    const glm::dmat4 upright = file.options.up == UpAxis::z ? z_up : glm::dmat4(1);
    Contents contents = SceneOfGltf(file, upright).read();
    if (file.options.fit == 0) return contents;
    const double scale = file.options.fit / longest_side(contents.box);
    return SceneOfGltf(file, glm::scale(glm::dmat4(1), glm::dvec3(scale)) * upright).read();
}

}  // namespace voxelume
