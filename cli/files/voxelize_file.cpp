// SPDX-License-Identifier: Apache-2.0
#include "cli/files/voxelize_file.hpp"

#include <algorithm>

#include "cli/shared/checks.hpp"
#include "cli/shared/scene_options.hpp"
#include "cli/shared/slice_names.hpp"
#include "cli/shared/tell.hpp"

namespace voxelume::cli {
namespace {

enum class InputKind : uint8_t { mesh, voxels, scene };

/// A frame of a glTF file is one of the scene that shows it.
InputKind kind_of(const std::string& file, bool is_frame) {
    const std::string ending = ending_of(file);
    if (ending == ".json" || file == "-") return InputKind::scene;
    const bool is_mesh = is_mesh_name(file) || !is_model_file(file);
    const bool is_moving = is_frame && (ending == ".gltf" || ending == ".glb");
    return is_mesh && !is_moving ? InputKind::mesh : InputKind::voxels;
}

/// Tells of voxels that were made of something, as in "12 triangles".
void tell_of(const VoxelizeCommand& command, const std::string& what, const VoxelizeReport& report,
             const Device& device) {
    if (!command.quiet)
        tell("{} to {}x{}x{} voxels of {:.4g} m in {:.2f} s on \"{}\": {} bricks\n", what,
             report.size[0], report.size[1], report.size[2], report.voxel_size, report.seconds,
             device.info().name, report.bricks);
    tell_notes(command, report.notes);
}

/// Returns the voxels' edge in metres.
double voxelize_mesh(const VoxelizeCommand& command) {
    if (command.frame > 0) fail_usage("voxelize: --frame is for scenes and for files that move");
    const VoxelizeOptions options = mesh_options_of(command);
    const Device device = Device::open(command.device);
    const VoxelizeReport report =
        voxelize(command.file, {command.outputs.begin(), command.outputs.end()}, device, options);
    tell_of(command, fmt::format("{} triangles", report.triangles), report, device);
    return report.voxel_size;
}

double voxelize_scene(const VoxelizeCommand& command, const Scene& scene) {
    const Device device = Device::open(command.device);
    const VoxelizeSceneOptions options{
        command.voxel_size, command.resolution, std::max(command.frame, 1), {}, command.without};
    const VoxelizeReport report =
        voxelize_scene(scene, {command.outputs.begin(), command.outputs.end()}, device, options);
    const size_t count = scene.object_names().size();
    tell_of(command, fmt::format("{} object{}", count, count == 1 ? "" : "s"), report, device);
    return report.voxel_size;
}

/// The scene that shows a file of voxels, or one that moves.
Scene scene_of_voxels_in(const std::string& file) {
    ImportOptions import;
    import.ground = false;
    return scene_of_file(file, import);
}

/// The voxels that a file has, or larger and smaller ones in their place.
double voxelize_voxels(const VoxelizeCommand& command, const std::string& file) {
    const bool has_other_size = command.voxel_size > 0 || command.resolution > 0;
    if (has_other_size || command.frame > 0 || !command.without.empty())
        return voxelize_scene(command, scene_of_voxels_in(file));
    for (const std::string& output : command.outputs)
        tell_notes(command, convert_voxels(file, output));
    return 0;
}

}  // namespace

bool is_mesh_input(const std::string& file, bool is_frame) {
    return kind_of(file, is_frame) == InputKind::mesh;
}

Scene scene_in(const VoxelizeCommand& command) {
    if (kind_of(command.file, true) == InputKind::voxels) return scene_of_voxels_in(command.file);
    return load_scene(command.file, {command.assets, {}, {}, 0});
}

void tell_notes(const VoxelizeCommand& command, const std::vector<std::string>& notes) {
    if (command.quiet) return;
    for (const std::string& note : notes) tell("note: {}\n", note);
}

double voxelize_file(const VoxelizeCommand& command) {
    const std::string file = first_slice(command.file);
    const InputKind kind = kind_of(file, command.frame > 0);
    if (kind == InputKind::mesh) return voxelize_mesh(command);
    refuse_mesh_options(command);
    return kind == InputKind::scene ? voxelize_scene(command, scene_in(command))
                                    : voxelize_voxels(command, file);
}

}  // namespace voxelume::cli
