// SPDX-License-Identifier: Apache-2.0
#include "cli/files/voxelize_options.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "cli/shared/checks.hpp"

namespace voxelume::cli {
namespace {

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

/// Without --surface a mesh is what suits it, but in files that hold cubes alone.
std::optional<Surface> surface_of(const VoxelizeCommand& command) {
    if (!command.surface.empty()) return choose(command.surface, kSurfaces, "voxelize: --surface");
    if (std::ranges::all_of(command.outputs, is_cube_name)) return Surface::cubes;
    return {};
}

}  // namespace

VoxelizeOptions mesh_options_of(const VoxelizeCommand& command) {
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

}  // namespace voxelume::cli
