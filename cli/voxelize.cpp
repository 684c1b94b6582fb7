// voxelume voxelize MESH: the voxels of a mesh, as files for this and other programs.
#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "runtime/assets/voxel_export.hpp"
#include "runtime/base/error.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/memory/plan.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"

namespace voxelume::cli {
namespace {

struct VoxelizeCommand {
    std::string mesh;
    std::vector<std::string> outputs;
    double voxel_size = 0;
    int resolution = 0;
    std::string surface = "smooth";
    std::string set = "supercover";
    std::string device;
    bool quiet = false;
};

constexpr std::array kSurfaces = {std::pair{std::string_view("smooth"), Surface::smooth},
                                  std::pair{std::string_view("cubes"), Surface::cubes},
                                  std::pair{std::string_view("exact"), Surface::exact}};
constexpr std::array kSets = {std::pair{std::string_view("supercover"), VoxelSet::supercover},
                              std::pair{std::string_view("thin"), VoxelSet::thin},
                              std::pair{std::string_view("solid"), VoxelSet::solid}};

/// What a scene would say of the mesh.
Model model_of(const VoxelizeCommand& command) {
    Model model;
    model.name = std::filesystem::path(command.mesh).stem();
    model.mesh = command.mesh;
    model.where = command.mesh;
    model.voxel_size = glm::dvec3(command.voxel_size);
    model.resolution =
        command.voxel_size > 0 ? 0 : (command.resolution > 0 ? command.resolution : 256);
    model.surface = choose(command.surface, kSurfaces, "voxelize: --surface");
    model.set = choose(command.set, kSets, "voxelize: --set");
    if (model.surface != Surface::cubes && command.set != "supercover")
        throw Error(ErrorKind::usage,
                    "voxelize: --set {}: only cubes have sets: add --surface cubes", command.set);
    return model;
}

int run(const VoxelizeCommand& command) {
    if (command.outputs.empty())
        throw Error(ErrorKind::usage, "voxelize: say where the voxels go: -o model.vxm");
    for (const std::string& path : command.outputs)
        check_output(path, {".vxm", ".vdb"}, "voxelize");
    const Model model = model_of(command);
    const VoxelizeOptions options{model.surface, model.set, kExportBand};
    const Mesh mesh = read_mesh(command.mesh);
    const Device device = Device::open(command.device);
    const GridPlan plan = plan_model(model, mesh);
    check_model(model, plan, device.info());

    const auto start = std::chrono::steady_clock::now();
    const BrickGrid grid = Voxelizer(device).voxelize(mesh, glm::dmat4(1), plan.frame, options);
    device.finish();
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const VoxelExport voxels(grid, mesh, model.surface, model.set);
    for (const std::string& path : command.outputs) {
        if (std::filesystem::path(path).extension() == ".vdb")
            voxels.write_vdb(path);
        else
            voxels.write_model(path);
    }
    if (!command.quiet)
        fmt::print(stderr,
                   "{} triangles to {}x{}x{} voxels of {:.4g} m in {:.2f} s on \"{}\": {} bricks\n",
                   mesh.triangles.size(), grid.frame.size.x, grid.frame.size.y, grid.frame.size.z,
                   grid.frame.voxel_edge.x, seconds, device.info().name, grid.brick_count);
    return 0;
}

}  // namespace

Action add_voxelize(CLI::App& app) {
    const auto command = std::make_shared<VoxelizeCommand>();
    app.add_option("MESH", command->mesh, "triangle mesh: .obj, .ply or .stl")->required();
    app.add_option("-o,--output", command->outputs,
                   "model .vxm, or OpenVDB volume .vdb; may be given again")
        ->allow_extra_args(false);
    const auto size = app.add_option("--voxel-size", command->voxel_size, "edge of a voxel, metres")
                          ->check(in_range(1e-9, 1e9));
    app.add_option("--resolution", command->resolution,
                   "voxels along the longest side, 256 without either")
        ->check(in_range(1, 16384, Number::whole))
        ->excludes(size);
    app.add_option("--surface", command->surface,
                   "smooth (a distance field; the default), cubes, or exact (triangles' lists)");
    app.add_option("--set", command->set, "of cubes: supercover (the default), thin or solid");
    app.add_option("--device", command->device, "auto, cpu, gpu, a number, or part of a name");
    app.add_flag("-q,--quiet", command->quiet, "print errors only");
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
