// SPDX-License-Identifier: Apache-2.0
// Measures the run time of voxelization with compiled kernels, for each surface and voxel set; with
// `peers` also OpenVDB's meshToLevelSet.
//
//   bench_voxelize [MESH] [voxels along the longest side ... | peers]
//
// Without a mesh it takes Debian's bunny. Medians of five runs, wall and CPU time; set
// POCL_MAX_PTHREAD_COUNT=1 for one core. "with its index" is a complete model, as is OpenVDB's.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>

#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"
#include "tests/bench/mesh_rows.hpp"
#include "tests/bench/peers/peer_level_set.hpp"

namespace voxelume {
namespace {

struct Kind {
    const char* name;
    VoxelizeOptions options;
};

void bench(const Device& device, const Mesh& mesh, int voxels, bool with_peers) {
    const Kind kinds[] = {{"supercover", {Surface::cubes, VoxelSet::supercover}},
                          {"thin", {Surface::cubes, VoxelSet::thin}},
                          {"solid", {Surface::cubes, VoxelSet::solid}},
                          {"smooth", {Surface::smooth}},
                          {"exact", {Surface::exact}}};
    const double voxel = longest_side(mesh) / voxels;
    const GridFrame frame = frame_around(mesh, glm::dvec3(voxel));
    Voxelizer voxelizer(device);
    for (const Kind& kind : kinds) {
        uint32_t bricks = 0;
        const auto make = [&] {
            BrickGrid grid = voxelizer.voxelize(mesh, glm::dmat4(1), frame, kind.options);
            bricks = grid.brick_count;
            return grid;
        };
        const Milliseconds made = median_time([&] { make(), device.finish(); });
        print_time(kind.name, voxels, made, fmt::format("{} bricks", bricks));
        uint64_t count = 0;
        const Milliseconds whole = median_time([&] {
            count = build_index(device, make()).voxel_count;
            device.finish();
        });
        print_time(fmt::format("{} with its index", kind.name), voxels, whole,
                   fmt::format("{} voxels", count));
        if (!with_peers || kind.options.surface != Surface::smooth) continue;
        const Milliseconds theirs = median_time([&] { level_set(mesh, voxel); });
        print_time("OpenVDB meshToLevelSet", voxels, theirs,
                   fmt::format("{:.1f} times our CPU time", theirs.cpu / whole.cpu));
    }
}

int run(int count, char** words) {
    MeshArguments arguments(count, words);
    if (arguments.voxels.empty()) arguments.voxels = {512, 1024};
    const Device device = Device::open();
    const Mesh mesh = read_mesh(arguments.mesh);
    print_heading(arguments.mesh, mesh);
    for (const int voxels : arguments.voxels) bench(device, mesh, voxels, arguments.with_peers);
    return 0;
}

}  // namespace
}  // namespace voxelume

int main(int count, char** arguments) {
    try {
        return voxelume::run(count, arguments);
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench_voxelize: {}\n", error.what());
        return 1;
    }
}
