// SPDX-License-Identifier: Apache-2.0
// voxelume voxelize FILE: writes the voxels of a mesh, of a file of voxels or of a scene to files
// for this and other programs.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/files/voxelize_frames.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/numbered_files.hpp"
#include "cli/shared/scene_options.hpp"
#include "cli/shared/slice_names.hpp"
#include "cli/shared/tell.hpp"

namespace voxelume::cli {
namespace {

struct VoxelizeCommand {
    std::string file;
    std::vector<std::string> outputs;
    std::string frames;  ///< a list like 1-10; empty: not given
    double voxel_size = 0;
    int resolution = 0;
    int frame = 0;                      ///< 0: not given
    std::string surface, set, normals;  ///< empty: not given
    std::string device;
    std::vector<std::filesystem::path> assets;
    std::vector<std::string> without;
    bool quiet = false;
};

constexpr std::array kSurfaces = {std::pair{std::string_view("smooth"), Surface::smooth},
                                  std::pair{std::string_view("cubes"), Surface::cubes},
                                  std::pair{std::string_view("exact"), Surface::exact}};
constexpr std::array kSets = {std::pair{std::string_view("supercover"), VoxelSet::supercover},
                              std::pair{std::string_view("thin"), VoxelSet::thin},
                              std::pair{std::string_view("solid"), VoxelSet::solid}};

constexpr std::array kNormals = {std::pair{std::string_view("faces"), CubeNormals::faces},
                                 std::pair{std::string_view("surface"), CubeNormals::surface}};

bool is_cube_name(const std::string& output) {
    return std::ranges::any_of(voxel_formats(), [&](const VoxelFormat& format) {
        return !format.has_surfaces && format.ending == ending_of(output);
    });
}

/// The surface to write. Without --surface, the kind that suits a mesh, or cubes if all outputs
/// hold only cubes.
std::optional<Surface> surface_of(const VoxelizeCommand& command) {
    if (!command.surface.empty()) return choose(command.surface, kSurfaces, "voxelize: --surface");
    if (std::ranges::all_of(command.outputs, is_cube_name)) return Surface::cubes;
    return {};
}

VoxelizeOptions options_of(const VoxelizeCommand& command) {
    VoxelizeOptions options;
    options.voxel_size = command.voxel_size;
    if (command.resolution > 0) options.resolution = command.resolution;
    options.surface = surface_of(command);
    if (!command.set.empty()) options.set = choose(command.set, kSets, "voxelize: --set");
    if (!command.normals.empty())
        options.normals = choose(command.normals, kNormals, "voxelize: --normals");
    const bool has_cubes = options.surface == Surface::cubes;
    if (!has_cubes && options.set != VoxelSet::supercover)
        fail_usage("voxelize: --set {}: only cubes have sets: add --surface cubes", command.set);
    if (!has_cubes && options.normals != CubeNormals::faces)
        fail_usage(
            "voxelize: --normals {}: only cubes have a choice of normals: add --surface cubes",
            command.normals);
    for (const std::string& output : command.outputs)
        if (!has_cubes && is_cube_name(output))
            fail_usage("voxelize: {}: files of this format hold cubes alone: add --surface cubes",
                       output);
    return options;
}

void tell_notes(const VoxelizeCommand& command, const std::vector<std::string>& notes) {
    if (command.quiet) return;
    for (const std::string& note : notes) tell("note: {}\n", note);
}

/// Prints what was voxelized; `what` is a text such as "12 triangles".
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
    const VoxelizeOptions options = options_of(command);
    const Device device = Device::open(command.device);
    const VoxelizeReport report =
        voxelize(command.file, {command.outputs.begin(), command.outputs.end()}, device, options);
    tell_of(command, fmt::format("{} triangles", report.triangles), report, device);
    return report.voxel_size;
}

/// Refuses options for meshes, because scenes and files of voxels always become cubes.
void refuse_mesh_options(const VoxelizeCommand& command) {
    const bool is_other = !command.surface.empty() && command.surface != "cubes";
    if (is_other || !command.set.empty() || !command.normals.empty())
        fail_usage(
            "voxelize: {} is for meshes: scenes and files of voxels become cubes, by the "
            "\"set\" of each model",
            is_other               ? "--surface"
            : !command.set.empty() ? "--set"
                                   : "--normals");
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

/// The scene that shows a file of voxels, which may move.
Scene scene_of_voxels_in(const std::string& file) {
    ImportOptions import;
    import.ground = false;
    return scene_of_file(file, import);
}

/// Writes a file's voxels as they are or, with another size, resampled.
double voxelize_voxels(const VoxelizeCommand& command, const std::string& file) {
    const bool has_other_size = command.voxel_size > 0 || command.resolution > 0;
    if (has_other_size || command.frame > 0 || !command.without.empty())
        return voxelize_scene(command, scene_of_voxels_in(file));
    for (const std::string& output : command.outputs)
        tell_notes(command, convert_voxels(file, output));
    return 0;
}

enum class InputKind : uint8_t { mesh, voxels, scene };

/// The kind of an input. A frame of a glTF file is a frame of the scene that shows the file.
InputKind kind_of(const std::string& file, bool is_frame) {
    const std::string ending = ending_of(file);
    if (ending == ".json" || file == "-") return InputKind::scene;
    const bool is_mesh = is_mesh_name(file) || !is_model_file(file);
    const bool is_moving = is_frame && (ending == ".gltf" || ending == ".glb");
    return is_mesh && !is_moving ? InputKind::mesh : InputKind::voxels;
}

Scene scene_in(const VoxelizeCommand& command) {
    if (kind_of(command.file, true) == InputKind::voxels) return scene_of_voxels_in(command.file);
    return load_scene(command.file, {command.assets, {}, {}, 0});
}

/// Writes the voxels of one file or frame. Returns their edge in metres, or 0 if it is the file's
/// own.
double voxelize_one(const VoxelizeCommand& command) {
    const std::string file = first_slice(command.file);
    const InputKind kind = kind_of(file, command.frame > 0);
    if (kind == InputKind::mesh) return voxelize_mesh(command);
    refuse_mesh_options(command);
    return kind == InputKind::scene ? voxelize_scene(command, scene_in(command))
                                    : voxelize_voxels(command, file);
}

/// The frames of one moving scene.
std::vector<VoxelizeNames> moving_frames(const VoxelizeCommand& command) {
    if (kind_of(command.file, true) == InputKind::mesh)
        fail_usage(
            "voxelize: {}: a mesh is one frame: leave out {}, or name files of frames, as "
            "#### does for 0001",
            command.file, command.frames.empty() ? "the #### of the output" : "--frames");
    if (command.file == "-")
        fail_usage("voxelize: -: frames are of a scene in a file; --frame chooses one of a stream");
    return names_of_frames({command.file, command.outputs}, command.frames,
                           scene_in(command).frames());
}

std::vector<VoxelizeNames> frames_of(const VoxelizeCommand& command) {
    if (!is_file_sequence(command.file)) return moving_frames(command);
    if (!command.without.empty()) fail_usage("voxelize: --without is for objects of scenes");
    if (command.frame > 0)
        fail_usage("voxelize: --frame is of one file: --frames chooses among numbered ones");
    std::vector<std::string> gaps;
    std::vector<VoxelizeNames> frames =
        names_of_files({command.file, command.outputs}, command.frames, gaps);
    if (!gaps.empty())
        tell_notes(command, {fmt::format("the numbers have {} gap{}; the first begins at {}",
                                         gaps.size(), gaps.size() == 1 ? "" : "s", gaps.front())});
    return frames;
}

/// Fixes the voxel size that the resolution gives for the first frame. Voxels of a fixed size lie
/// on the world's lattice, so the first frame is made again with it.
void take_size(VoxelizeCommand& command) {
    VoxelizeCommand first = command;
    first.quiet = true;
    command.voxel_size = voxelize_one(first);
    if (command.voxel_size > 0) command.resolution = 0;
}

/// Writes all frames with voxels of one size.
void voxelize_frames(VoxelizeCommand command) {
    const std::vector<VoxelizeNames> frames = frames_of(command);
    const bool is_moving = !is_file_sequence(command.file);
    for (size_t i = 0; i < frames.size(); ++i) {
        command.file = frames[i].file;
        command.outputs = frames[i].outputs;
        if (is_moving) command.frame = frames[i].frame;
        if (i == 0 && frames.size() > 1 && command.voxel_size == 0) take_size(command);
        voxelize_one(command);
    }
}

int run(const VoxelizeCommand& command) {
    if (command.outputs.empty()) fail_usage("voxelize: say where the voxels go: -o model.vxm");
    for (const std::string& path : command.outputs) check_voxels_output(path, "voxelize");
    const bool has_frames = is_file_sequence(command.file) || !command.frames.empty() ||
                            std::ranges::any_of(command.outputs, is_numbered);
    if (has_frames)
        voxelize_frames(command);
    else
        voxelize_one(command);
    return 0;
}

}  // namespace

Action add_voxelize(CLI::App& app) {
    const auto command = std::make_shared<VoxelizeCommand>();
    app.add_option(
           "FILE", command->file,
           "triangle mesh, .obj .ply .stl .gltf .glb; file of voxels, as `info` tells; or "
           "scene, .json, all of whose objects become cubes; - is a scene from standard input")
        ->required();
    app.add_option("-o,--output", command->outputs,
                   fmt::format("output: model .vxm or OpenVDB volume .vdb, or of cubes {}; may be "
                               "given again",
                               endings_of_voxels(false)))
        ->allow_extra_args(false);
    const auto size =
        app.add_option("--voxel-size", command->voxel_size, "edge of a voxel in metres")
            ->check(in_range(1e-9, 1e9));
    app.add_option("--resolution", command->resolution,
                   "voxels along the longest side; if neither is given, 256 of a mesh or, for "
                   ".vox, 254, of "
                   "points as few as leave no gaps, and else the voxels that there are")
        ->check(in_range(1, 16384, Number::whole))
        ->excludes(size);
    app.add_option("--surface", command->surface,
                   "surface of a mesh: smooth (a distance field; the default, but for files of "
                   "cubes and meshes of points and lines), cubes, or exact (lists of triangles)")
        ->type_name("smooth|cubes|exact");
    app.add_option("--set", command->set,
                   "voxel set of a mesh as cubes: supercover (the default), thin or solid")
        ->type_name("supercover|thin|solid");
    app.add_option("--normals", command->normals,
                   "normals that light cubes: faces (the default), or surface (those of the mesh, "
                   "kept in .vxm)")
        ->type_name("faces|surface");
    const auto frame =
        app.add_option("--frame", command->frame, "frame of a scene that moves; 1 by default")
            ->check(in_range(1, 1000000, Number::whole));
    app.add_option("--frames", command->frames,
                   "frames of a scene that moves, or numbers of files, like 1-10,20; by default "
                   "all, where an output or FILE has #### for the number")
        ->excludes(frame);
    app.add_option("--without", command->without,
                   "object of a scene to leave out, by its name, such as its ground; may be given "
                   "again")
        ->allow_extra_args(false);
    app.add_option("--assets", command->assets,
                   "folder to look for a scene's models in; may be given again")
        ->allow_extra_args(false);
    app.add_option("--device", command->device,
                   "device: auto, cpu, gpu, a number, or part of a name")
        ->type_name("DEVICE");
    app.add_flag("-q,--quiet", command->quiet, "print errors only");
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
