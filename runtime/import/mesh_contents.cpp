// SPDX-License-Identifier: Apache-2.0
// mesh file -> contents of a scene
#include <cmath>

#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/import/contents.hpp"

namespace voxelume {
namespace {

constexpr int kVoxelsAlong = 256;  // the longest side

/// The box after a quarter turn that brings Z up.
Bounds z_up(const Bounds& box) {
    return {{box.min.x, box.min.z, -box.max.y}, {box.max.x, box.max.z, -box.min.y}};
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
    const bool has_colors = !file.assets.mesh(file.path).vertex_colors.empty();
    Contents contents;
    contents.box = fitted_box(box, file.options);
    if (turns) contents.box = z_up(contents.box);
    // Rounded up, so that there are no more voxels than that.
    const double edge = longest_side(contents.box) / kVoxelsAlong;
    contents.voxel_size = glm::dvec3(rounded(edge * 1.0005, 4));
    contents.materials.push_back(fmt::format("{}: {{\"color\": {}, \"specular\": 0.1}}",
                                             json_text(name),
                                             has_colors ? "[1, 1, 1]" : "[0.72, 0.7, 0.68]"));
    contents.models.push_back(
        fmt::format("{}: {{\"mesh\": {}, \"surface\": \"exact\", \"shading\": \"smooth\"{}}}",
                    json_text(name), json_text(file.name), fit_member(file.options)));
    contents.objects.push_back(
        fmt::format("{{\"name\": {0}, \"model\": {0}, \"material\": {0}{1}}}", json_text(name),
                    turns ? ", \"turn\": [0, -90, 0]" : ""));
    return contents;
}

}  // namespace voxelume
