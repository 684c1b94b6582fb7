// SPDX-License-Identifier: Apache-2.0
// voxelume voxelize MESH: the voxels of a mesh, as files for this and other programs.
#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "cli/tell.hpp"

namespace voxelume::cli {
namespace {

struct VoxelizeCommand {
    std::string mesh;
    std::vector<std::string> outputs;
    double voxel_size = 0;
    int resolution = 0;
    std::string surface = "smooth";
    std::string set = "supercover";
    std::string normals = "faces";
    std::string device;
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

VoxelizeOptions options_of(const VoxelizeCommand& command) {
    VoxelizeOptions options;
    options.voxel_size = command.voxel_size;
    if (command.resolution > 0) options.resolution = command.resolution;
    options.surface = choose(command.surface, kSurfaces, "voxelize: --surface");
    options.set = choose(command.set, kSets, "voxelize: --set");
    if (options.surface != Surface::cubes && command.set != "supercover")
        fail_usage("voxelize: --set {}: only cubes have sets: add --surface cubes", command.set);
    options.normals = choose(command.normals, kNormals, "voxelize: --normals");
    if (options.surface != Surface::cubes && options.normals != CubeNormals::faces)
        fail_usage(
            "voxelize: --normals {}: only cubes have a choice of normals: add --surface cubes",
            command.normals);
    return options;
}

int run(const VoxelizeCommand& command) {
    if (command.outputs.empty()) fail_usage("voxelize: say where the voxels go: -o model.vxm");
    for (const std::string& path : command.outputs)
        check_output(path, {".vxm", ".vdb", ".vox", ".kv6", ".binvox", ".npy", ".nrrd"},
                     "voxelize");
    const VoxelizeOptions options = options_of(command);
    const Device device = Device::open(command.device);
    const VoxelizeReport report =
        voxelize(command.mesh, {command.outputs.begin(), command.outputs.end()}, device, options);
    if (!command.quiet)
        tell("{} triangles to {}x{}x{} voxels of {:.4g} m in {:.2f} s on \"{}\": {} bricks\n",
             report.triangles, report.size[0], report.size[1], report.size[2], report.voxel_size,
             report.seconds, device.info().name, report.bricks);
    if (!command.quiet)
        for (const std::string& note : report.notes) tell("note: {}\n", note);
    return 0;
}

}  // namespace

Action add_voxelize(CLI::App& app) {
    const auto command = std::make_shared<VoxelizeCommand>();
    app.add_option("MESH", command->mesh, "triangle mesh: .obj, .ply, .stl, .gltf or .glb")
        ->required();
    app.add_option("-o,--output", command->outputs,
                   "output: model .vxm or OpenVDB volume .vdb, or of cubes .vox .kv6 .binvox .npy "
                   ".nrrd; may be given again")
        ->allow_extra_args(false);
    const auto size =
        app.add_option("--voxel-size", command->voxel_size, "edge of a voxel in metres")
            ->check(in_range(1e-9, 1e9));
    app.add_option("--resolution", command->resolution,
                   "voxels along the longest side; 256 if neither is given")
        ->check(in_range(1, 16384, Number::whole))
        ->excludes(size);
    app.add_option(
           "--surface", command->surface,
           "surface: smooth (a distance field; the default), cubes, or exact (lists of triangles)")
        ->type_name("smooth|cubes|exact");
    app.add_option("--set", command->set,
                   "voxel set of cubes: supercover (the default), thin or solid")
        ->type_name("supercover|thin|solid");
    app.add_option("--normals", command->normals,
                   "normals that light cubes: faces (the default), or surface (those of the mesh, "
                   "kept in .vxm)")
        ->type_name("faces|surface");
    app.add_option("--device", command->device,
                   "device: auto, cpu, gpu, a number, or part of a name")
        ->type_name("DEVICE");
    app.add_flag("-q,--quiet", command->quiet, "print errors only");
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
