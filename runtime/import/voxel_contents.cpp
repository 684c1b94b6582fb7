// SPDX-License-Identifier: Apache-2.0
// file of the voxels of one model, or voxels in memory -> contents of a scene
#include "runtime/base/error.hpp"
#include "runtime/base/input_file.hpp"
#include "runtime/base/text.hpp"
#include "runtime/import/contents.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/voxels/model_file.hpp"

namespace voxelume {
namespace {

/// The surface that a file has voxels of.
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

Contents contents_of(const Model& model, const ImportedFile& file) {
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
                    voxels.colors.empty() ? "[0.72, 0.7, 0.68]" : "[1, 1, 1]"));
    contents.models.push_back(fmt::format("{}: {{\"voxels\": {}, \"surface\": \"{}\"{}}}",
                                          json_text(name), json_text(file.name),
                                          kind_of(model.surface).name, fit_member(file.options)));
    contents.objects.push_back(
        fmt::format("{{\"name\": {0}, \"model\": {0}, \"material\": {0}}}", json_text(name)));
    return contents;
}

}  // namespace

Contents voxel_contents(const ImportedFile& file) {
    Model model;
    model.voxels = file.path;
    model.surface = surface_in(file.path);
    return contents_of(model, file);
}

Contents given_contents(const ImportedFile& file, const std::shared_ptr<const VoxelModel>& given) {
    Model model;
    model.voxels = file.path;
    model.given = given;
    model.surface = Surface::cubes;
    return contents_of(model, file);
}

}  // namespace voxelume
