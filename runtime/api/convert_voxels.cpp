// SPDX-License-Identifier: Apache-2.0
// Conversion of voxel files from one format to another, for callers.
#include <algorithm>

#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/api/border/process.hpp"
#include "runtime/assets/voxel_export.hpp"
#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/base/text.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/import/scene_of_file.hpp"
#include "runtime/io/arrays/array_files.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/volume/volume_frame_text.hpp"
#include "runtime/io/volume_file.hpp"
#include "runtime/io/volume_format_table.hpp"
#include "runtime/io/voxel_art/cube_list.hpp"
#include "runtime/io/voxel_file_table.hpp"
#include "runtime/io/voxel_output_table.hpp"
#include "runtime/voxelume/files.hpp"
#include "runtime/voxelume/import.hpp"

namespace voxelume {
namespace {

/// True if a file has voxels of a model, and no volumetric image.
bool holds_model(const std::filesystem::path& path) {
    const std::string ending = ending_of(path);
    if (ending == ".vox" || ending == ".vxm" || ending == ".vdb") return true;
    return voxel_format_named(path) != nullptr && !is_volume_nrrd(path);
}

/// True if a volumetric image may have such a name.
bool is_volume_name(const std::filesystem::path& path) {
    const std::string ending = ending_of(path);
    return std::ranges::any_of(volume_format_table(), [&](const VolumeFormatEntry& entry) {
        return std::ranges::any_of(entry.endings,
                                   [&](const char* name) { return name && ending == name; });
    });
}

/// True for an OpenVDB file of a display. Throws as read_vdb_summary does.
bool is_volume_vdb(const std::filesystem::path& path) {
    return ending_of(path) == ".vdb" && read_vdb_summary(path).metadata.contains(kFrameKey);
}

/// The cells of a volumetric image that are at least half opaque.
CubeList cubes_of_volume(const std::filesystem::path& path) {
    const Volume volume = read_volume(path);
    if (volume.frame.layout != VolumeLayout::lattice)
        throw Error(ErrorKind::input, "{}: its voxels lie along rays, and not in a lattice",
                    path.string());
    CubeList cubes;
    cubes.origin = volume.frame.origin;
    cubes.voxel_edge = volume.frame.edge;
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        if (volume.opacities[i] < 0.5f) continue;
        const glm::vec3& c = volume.colors[i];
        cubes.cells.push_back(cell_of(volume.frame, volume.indices[i]));
        cubes.colors.push_back(uint32_t(srgb_code(c.r)) | uint32_t(srgb_code(c.g)) << 8 |
                               uint32_t(srgb_code(c.b)) << 16);
    }
    shrink(cubes);
    return cubes;
}

/// The voxels of a model file: of an array, those that pictures of the file show; of a smooth
/// surface, the cubes inside it.
VoxelModel model_of(const std::filesystem::path& path, WriterNotes& notes) {
    const VoxelFileFormat* const format = voxel_file_format(path);
    const std::string ending = ending_of(path);
    const bool is_array = format && format->array;
    const bool may_have_surface = ending == ".vxm" || ending == ".vdb";
    if (!is_model_file(path) || !(is_array || may_have_surface))
        return read_voxel_model(path, Surface::cubes);
    const v1::Scene handle = v1::scene_of_file(path, {.ground = false});
    const Model& shown = api::inside(handle).models.front();
    if (is_array || shows_voxels(shown.surface))
        return read_voxel_model(path, Surface::cubes, shown.part, shown.values);
    if (lists_primitives(shown.surface))
        throw Error(ErrorKind::input,
                    "{}: holds triangles in voxels (\"exact\"), which have no inside: voxelize the "
                    "mesh again, as cubes",
                    SourcePlace(path.string()));
    const VoxelModel smooth = read_voxel_model(path, shown.surface, shown.part, shown.values);
    notes.emplace_back(smooth.colors.empty()
                           ? "a smooth surface became the cubes inside it"
                           : "a smooth surface became the cubes inside it, without its colours");
    return cubes_inside(smooth);
}

/// The materials of a MagicaVoxel file's palette, numbered as in the model's attributes; none of
/// other files.
std::vector<CubeMaterial> materials_of(const std::filesystem::path& from, const VoxelModel& model) {
    if (ending_of(from) != ".vox" || model.groups.empty()) return {};
    const VoxFile file = read_vox_file(from);
    std::vector<CubeMaterial> materials(model.groups.size());
    for (int entry = 0; entry < 256; ++entry) {
        const std::string name = material_name(file, entry);
        const auto group = std::ranges::find(model.groups, name);
        if (!name.empty() && group != model.groups.end())
            materials[size_t(group - model.groups.begin())].vox = file.materials[size_t(entry)];
    }
    return materials;
}

WriterNotes write_voxels(const std::filesystem::path& from, const std::filesystem::path& to) {
    const VoxelOutputFormat& format = check_voxel_output(to);
    if (format.write && !holds_model(from)) return format.write(to, cubes_of_volume(from));
    WriterNotes notes;
    VoxelModel model = model_of(from, notes);
    const std::vector<CubeMaterial> materials = materials_of(from, model);
    if (!materials.empty() && !format.keeps_materials)
        notes.emplace_back("metal, glass, and what gives off light became plain colours");
    const WriterNotes of_writer = format.write ? format.write(to, cube_list(model, materials))
                                               : write_cubes(to, VoxelExport(std::move(model)));
    notes.insert(notes.end(), of_writer.begin(), of_writer.end());
    return notes;
}

}  // namespace

namespace v1 {

bool can_convert_voxels(const std::filesystem::path& from, const std::filesystem::path& to) {
    const VoxelOutputFormat* const format = voxel_output_format(to);
    if (!format) return false;
    // Volumetric images are written as .kv6 and .nrrd by writers of their own.
    if (format->write && !is_volume_name(to)) return true;
    return holds_model(from) && !api::guarded([&] { return is_volume_vdb(from); });
}

std::vector<std::string> convert_voxels(const std::filesystem::path& from,
                                        const std::filesystem::path& to) {
    return api::guarded([&] {
        api::apply_process_options();
        return write_voxels(from, to);
    });
}

}  // namespace v1
}  // namespace voxelume
