// SPDX-License-Identifier: Apache-2.0
// file of the voxels of one model, or voxels in memory -> contents of a scene
#include "runtime/base/error.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/text.hpp"
#include "runtime/import/contents.hpp"
#include "runtime/io/arrays/array_voxels.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/voxel_file_table.hpp"
#include "runtime/io/voxels/model_file.hpp"

namespace voxelume {
namespace {

/// The surface for which a file has voxels.
Surface surface_in(const std::filesystem::path& path) {
    if (ending_of(path) == ".vxm") {
        const ModelSummary summary = read_model_summary(path);
        const auto found = summary.header.find("surface");
        for (const SurfaceKind& kind : kSurfaceKinds)
            if (found != summary.header.end() && found->second == kind.name) return kind.surface;
        InputFile(path).refuse("has no voxels of a model that this voxelume reads");
    }
    if (ending_of(path) == ".vox") return Surface::cubes;
    for (const VdbSummary& grid : read_vdb_summary(path).grids)
        if (grid.grid_class == "level set") return Surface::smooth;
    return Surface::cubes;
}

/// Chooses what is shown of an array: its colours, its labels, or the surface that separates its
/// values best. Returns the keys of the scene's model for it.
std::string choose_values(const CellArray& array, Model& model) {
    model.surface = Surface::cubes;
    if (array.is_color()) return {};
    const ArraySummary summary = summary_of_array(array);
    const auto refuse = [&](const char* why) {
        InputFile(array.data).refuse(fmt::format("has no voxels to show: {}", why));
    };
    // Values far below 0, as Hounsfield's, are measured.
    const bool are_labels = summary.labels.size() > 1 && summary.labels.begin()->first >= -1;
    if (are_labels) {
        model.values.each_label = true;
        return ", \"label\": \"each\"";
    }
    if (summary.labels.size() == 1) {
        const int label = summary.labels.begin()->first;
        if (label > 0) return {};
        model.values.label = label;
        return fmt::format(", \"label\": {}", label);
    }
    if (!(summary.min <= summary.max)) refuse("no value is finite");
    if (summary.min == 0 && summary.max == 0) refuse("all values are 0");
    model.values.iso = rounded(summary.threshold, 4);
    model.surface = Surface::smooth;
    return fmt::format(", \"iso\": {}", *model.values.iso);
}

std::string choose_surface(const std::filesystem::path& path, Model& model) {
    const VoxelFileFormat* format = voxel_file_format(path);
    if (format && format->array) return choose_values(format->array(path), model);
    model.surface = format ? Surface::cubes : surface_in(path);
    return {};
}

/// A point or a size after the quarter turn that brings Z up.
glm::dvec3 z_up(const glm::dvec3& p) {
    return {p.x, p.z, -p.y};
}

/// Turns everything that is shown so that Z is up. Returns the object's key for it.
const char* turn_up(Contents& contents) {
    const Bounds box = {z_up(contents.box.min), z_up(contents.box.max)};
    contents.box = {glm::min(box.min, box.max), glm::max(box.min, box.max)};
    contents.voxel_size = glm::abs(z_up(contents.voxel_size));
    contents.lattice = z_up(contents.lattice);
    return ", \"turn\": [0, -90, 0]";
}

/// Sets the distance between voxels of this edge as the options ask for. Returns the object's key
/// for it.
std::string set_apart(const glm::dvec3& edge, const ImportOptions& options, Contents& contents) {
    if (!options.spacing) return {};
    const glm::dvec3 scale = *options.spacing / edge;
    contents.box = {contents.box.min * scale, contents.box.max * scale};
    contents.lattice *= scale;
    contents.voxel_size = *options.spacing;
    return fmt::format(", \"scale\": {}", json_list(scale));
}

/// `chosen` are members of the scene's model.
Contents contents_of(const Model& model, const std::string& chosen, const ImportedFile& file) {
    const Bounds box = file.assets.box_of_file(model, true);
    const VoxelModel& voxels = file.assets.voxels(model);
    const std::string name = stem_of(file);
    Contents contents;
    contents.box = fitted_box(box, file.options);
    const double scale = longest_side(contents.box) / longest_side(box);
    const glm::dvec3 shift = contents.box.min - scale * box.min;
    contents.voxel_size = scale * voxels.frame.voxel_edge;
    contents.lattice = scale * voxels.frame.origin + shift;
    contents.materials.push_back(
        fmt::format("{}: {{\"color\": {}}}", json_text(name),
                    voxels.has_colors() ? "[1, 1, 1]" : "[0.72, 0.7, 0.68]"));
    contents.models.push_back(fmt::format(
        "{}: {{\"voxels\": {}, \"surface\": \"{}\"{}{}}}", json_text(name), json_text(file.name),
        kind_of(model.surface).name, chosen, fit_member(file.options)));
    std::string place = set_apart(voxels.frame.voxel_edge, file.options, contents);
    if (file.options.up == UpAxis::z) place += turn_up(contents);
    contents.objects.push_back(fmt::format(
        "{{\"name\": {0}, \"model\": {0}, \"material\": {0}{1}}}", json_text(name), place));
    return contents;
}

}  // namespace

Contents voxel_contents(const ImportedFile& file) {
    Model model;
    model.voxels = file.path;
    const std::string chosen = choose_surface(file.path, model);
    return contents_of(model, chosen, file);
}

Contents given_contents(const ImportedFile& file, const std::shared_ptr<const VoxelModel>& given) {
    Model model;
    model.voxels = file.path;
    model.given = given;
    model.surface = Surface::cubes;
    return contents_of(model, "", file);
}

}  // namespace voxelume
