// SPDX-License-Identifier: Apache-2.0
// glTF file -> contents of a scene: a model for each mesh that is used, an object for each node
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>

#include "runtime/base/error.hpp"
#include "runtime/import/contents.hpp"
#include "runtime/import/gltf_sight.hpp"
#include "runtime/import/gltf_values.hpp"
#include "runtime/io/gltf/gltf_mesh.hpp"
#include "runtime/io/gltf/gltf_nodes.hpp"

namespace voxelume {
namespace {

/// Voxels along the longest side: textures show in voxels.
constexpr int kVoxelsAlong = 256, kTexturedVoxelsAlong = 512;

/// Whether a mesh has triangles, and not points and lines alone.
bool has_faces(const GltfValue& mesh) {
    return std::ranges::any_of(mesh.items("primitives"), [](const GltfValue& primitive) {
        return primitive.count("mode", 4) >= 4 && primitive.at("attributes").has("POSITION");
    });
}

/// A node that some axis of its map makes flat can't be placed.
bool can_be_placed(const glm::dmat4& map) {
    double least = INFINITY, most = 0;
    for (int axis = 0; axis < 3; ++axis) {
        least = std::min(least, glm::length(glm::dvec3(map[axis])));
        most = std::max(most, glm::length(glm::dvec3(map[axis])));
    }
    const double volume = std::abs(glm::determinant(glm::dmat3(map)));
    return std::isfinite(most) && least > 1e-4 * most && volume > 1e-9 * most * most * most;
}

std::string matrix_text(const glm::dmat4& m) {
    std::array<std::string, 3> rows;
    for (int row = 0; row < 3; ++row)
        rows[size_t(row)] =
            fmt::format("[{}, {}, {}, {}]", m[0][row], m[1][row], m[2][row], m[3][row]);
    return fmt::format("[{}]", fmt::join(rows, ", "));
}

class SceneOfGltf {
  public:
    explicit SceneOfGltf(const ImportedFile& file)
        : file_(file), gltf_(file.assets.gltf_file(file.path)), root_(gltf_.root()) {
        for (size_t i = 0; i < gltf_.material_names().size(); ++i)
            material_numbers_.emplace(gltf_.material_names()[i], i);
    }

    Contents read() {
        contents_.box = {glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
        const std::vector<GltfNode> nodes = gltf_nodes(gltf_);
        for (const GltfNode& node : nodes)
            if (node.mesh >= 0) add_object(node);
        if (contents_.objects.empty() || !(longest_side(contents_.box) > 0))
            throw Error(ErrorKind::input, "{}: has no triangles to show",
                        SourcePlace(file_.path.string()));
        contents_.voxel_size = mesh_voxel_size(contents_.box, has_textures_);
        contents_.materials.insert(contents_.materials.begin(),
                                   fmt::format("\"default\": {{\"color\": {}, \"specular\": 0.1}}",
                                               has_colors_ ? "[1, 1, 1]" : "[0.72, 0.7, 0.68]"));
        contents_.observer = gltf_observer(gltf_, nodes, contents_.box, file_.options.size);
        contents_.lights = gltf_light_items(gltf_, nodes, contents_.box);
        return std::move(contents_);
    }

  private:
    void add_object(const GltfNode& node) {
        const GltfValue mesh = root_.item("meshes", size_t(node.mesh));
        if (!has_faces(mesh) || !can_be_placed(node.world_from_node)) return;
        Model model;
        model.mesh = file_.path;
        model.part = node.mesh + 1;
        const MeshSummary& summary = *file_.assets.summary_of(model);
        has_textures_ |= summary.paint.textures > 0;
        has_colors_ |= summary.paint.is_there();
        const std::string wanted = node.name.empty() ? mesh.text("name") : node.name;
        contents_.objects.push_back(fmt::format(
            "{{\"name\": {}, \"model\": {}{}{}}}",
            json_text(objects_.unique(wanted.empty() ? "object" : wanted)),
            json_text(model_name(node.mesh, mesh)), materials_member(summary),
            node.world_from_node == glm::dmat4(1)
                ? ""
                : fmt::format(",\n     \"matrix\": {}", matrix_text(node.world_from_node))));
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 p(node.world_from_node * glm::dvec4(corner(summary.surface, i), 1));
            contents_.box = {glm::min(contents_.box.min, p), glm::max(contents_.box.max, p)};
        }
    }

    const std::string& model_name(int number, const GltfValue& mesh) {
        const auto [entry, is_new] = models_.try_emplace(number);
        if (!is_new) return entry->second;
        const std::string name = mesh.text("name");
        entry->second =
            model_names_.unique(name.empty() ? fmt::format("mesh {}", number + 1) : name);
        contents_.models.push_back(
            fmt::format("{}: {{\"mesh\": {}, \"part\": {}, \"surface\": \"exact\"}}",
                        json_text(entry->second), json_text(file_.name), number + 1));
        return entry->second;
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

    std::string add_material(const std::string& group) {
        std::string name = material_names_.unique(group);
        const GltfValue material = root_.item("materials", material_numbers_.at(group));
        contents_.has_glass |= gltf_transmits(material);
        contents_.materials.push_back(
            fmt::format("{}: {{{}}}", json_text(name), gltf_values(material)));
        return name;
    }

    const ImportedFile& file_;
    const GltfFile& gltf_;
    GltfValue root_;
    Contents contents_;
    std::map<int, std::string> models_;
    std::map<std::string, size_t> material_numbers_;  ///< by group
    std::map<std::string, std::string> materials_;    ///< by group
    NameList objects_{{"ground"}}, model_names_{{"ground"}};
    NameList material_names_{{"default", "ground"}};
    bool has_textures_ = false, has_colors_ = false;
};

}  // namespace

Contents gltf_contents(const ImportedFile& file) {
    // A size, or another axis that is up, is that of all objects together: they become one model.
    if (file.options.fit > 0 || file.options.up == UpAxis::z) return mesh_contents(file);
    return SceneOfGltf(file).read();
}

}  // namespace voxelume
