// SPDX-License-Identifier: Apache-2.0
// voxelume voxelize FILE: writes the voxels of a mesh, of a file of voxels or of a scene to files
// for this and other programs.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "cli/files/voxelize_file.hpp"
#include "cli/files/voxelize_frames.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"

namespace voxelume::cli {
namespace {

int run(const VoxelizeCommand& command) {
    if (command.outputs.empty()) fail_usage("voxelize: say where the voxels go: -o model.vxm");
    for (const std::string& path : command.outputs) check_voxels_output(path, "voxelize");
    if (has_frames(command))
        voxelize_frames(command);
    else
        voxelize_file(command);
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
