// SPDX-License-Identifier: Apache-2.0
// mesh file -> contents of a scene
#include <algorithm>
#include <cmath>

#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/import/contents.hpp"
#include "runtime/import/mtl_values.hpp"

namespace voxelume {
namespace {

/// The box after a quarter turn that brings Z up.
Bounds z_up(const Bounds& box) {
    return {{box.min.x, box.min.z, -box.max.y}, {box.max.x, box.max.z, -box.min.y}};
}

/// The values of a material for surfaces that have none in the file.
std::string plain_values(const MeshSummary& mesh) {
    return fmt::format("\"color\": {}, \"specular\": 0.1",
                       mesh.paint.is_there() ? "[1, 1, 1]" : "[0.72, 0.7, 0.68]");
}

/// A material that a group of faces has in the file.
struct FileMaterial {
    std::string group, values;
    bool transmits = false;
};

/// The materials of an OBJ file's library.
std::vector<FileMaterial> materials_of(const ImportedFile& file, const MeshSummary& mesh) {
    std::vector<FileMaterial> materials;
    std::vector<std::string> faults;  // the mesh's summary has them, too
    for (MtlMaterial material :
         read_material_libraries(file.path, mesh.material_libraries, faults)) {
        if (mesh.paint.uvs == 0)  // without UVs the maps can't be placed
            material.emission_map = material.roughness_map = material.metallic_map = {};
        materials.push_back({material.name, mtl_values(material), mtl_transmits(material)});
    }
    return materials;
}

/// Adds the materials that the mesh's groups have in the file. Returns the keys of the object that
/// refer to them. All other groups have a material named like the model or, where the file's own
/// material is missing, the scene's "default", so that a warning asks for another one.
std::string add_materials(const ImportedFile& file, const MeshSummary& mesh,
                          const std::string& name, Contents& contents) {
    const std::vector<FileMaterial> materials = materials_of(file, mesh);
    std::vector<std::string> members;
    NameList names({"default", "ground", name});
    for (const std::string& group : mesh.group_names) {
        const auto found = std::ranges::find(materials, group, &FileMaterial::group);
        if (found == materials.end()) continue;
        const std::string material = names.unique(group);
        contents.has_glass |= found->transmits;
        contents.materials.push_back(fmt::format("{}: {{{}}}", json_text(material), found->values));
        members.push_back(fmt::format("{}: {}", json_text(group), json_text(material)));
    }
    std::string text;
    if (members.empty() || members.size() < mesh.group_names.size()) {
        const std::string plain = json_text(mesh.missing_materials.empty() ? name : "default");
        contents.materials.push_back(fmt::format("{}: {{{}}}", plain, plain_values(mesh)));
        text = fmt::format(", \"material\": {}", plain);
    }
    if (!members.empty())
        text += fmt::format(",\n     \"materials\": {{{}}}", fmt::join(members, ",\n       "));
    return text;
}

}  // namespace

Contents mesh_contents(const ImportedFile& file) {
    Model model;
    model.mesh = file.path;
    const Bounds box = file.assets.box_of_file(model, true);
    if (!(longest_side(box) > 0))
        throw Error(ErrorKind::input, "{}: all of the mesh is one point, which has no picture",
                    file.path.string());
    const bool turns = file.options.up == UpAxis::z ||
                       (file.options.up == UpAxis::automatic && ending_of(file.path) == ".stl");
    const std::string name = stem_of(file);
    Contents contents;
    contents.box = fitted_box(box, file.options);
    if (turns) contents.box = z_up(contents.box);
    const MeshSummary& summary = *file.assets.summary_of(model);
    contents.voxel_size = mesh_voxel_size(contents.box, summary.paint.textures > 0);
    const double scale = longest_side(contents.box) / longest_side(box);
    if (!has_area(summary))
        contents.voxel_size = point_voxel_size(file.assets.mesh(file.path), contents, scale);
    contents.models.push_back(fmt::format("{}: {{\"mesh\": {}, {}{}}}", json_text(name),
                                          json_text(file.name), surface_members(summary, true),
                                          fit_member(file.options)));
    const std::string members = add_materials(file, summary, name, contents);
    contents.objects.push_back(fmt::format("{{\"name\": {0}, \"model\": {0}{1}{2}}}",
                                           json_text(name), members,
                                           turns ? ", \"turn\": [0, -90, 0]" : ""));
    return contents;
}

}  // namespace voxelume
