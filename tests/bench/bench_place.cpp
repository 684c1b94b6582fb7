// SPDX-License-Identifier: Apache-2.0
// Measures the run time of placing and indexing with compiled kernels; with `peers` also OpenVDB's
// resampleToMatch of a level set.
//
//   bench_place [MESH] [voxels along the longest side of the world ... | peers]
//
// Without a mesh it takes Debian's bunny. Medians of five runs, wall and CPU time; set
// POCL_MAX_PTHREAD_COUNT=1 for one core.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>

#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/place/place.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"
#include "tests/bench/mesh_rows.hpp"
#include "tests/bench/peers/peer_level_set.hpp"

namespace voxelume {
namespace {

/// A world of the object's voxels that contains it under every turn.
GridFrame world_around(const GridFrame& object, int voxels) {
    const glm::dvec3 middle = object.origin + object.voxel_edge * glm::dvec3(object.size) * 0.5;
    const glm::ivec3 size(voxels);
    return {.origin = middle - object.voxel_edge * glm::dvec3(size) * 0.5,
            .voxel_edge = object.voxel_edge,
            .size = size};
}

glm::dmat4 turned_about_middle(const GridFrame& object, const glm::dvec3& turn, double scale) {
    const glm::dvec3 middle = object.origin + object.voxel_edge * glm::dvec3(object.size) * 0.5;
    glm::dmat4 map = affine_from_factors({0, 0, 0}, turn, glm::dvec3(scale));
    map[3] = glm::dvec4(middle - glm::dmat3(map) * middle, 1);
    return map;
}

void index_model(const Device& device, const BrickGrid& grid, const char* name, int voxels) {
    uint64_t count = 0;
    const Milliseconds time = median_time([&] {
        count = build_index(device, grid).voxel_count;
        device.finish();
    });
    print_time(fmt::format("index {}", name), voxels, time, fmt::format("{} voxels", count));
}

Milliseconds place_model(const Device& device, const BrickGrid& grid, const glm::dmat4& map,
                         const std::string& name, int voxels) {
    const std::vector<PlacedObject> objects = {
        {.grid = &grid, .world_from_object = map, .material_of_group = {0}}};
    const GridFrame world = world_around(grid.frame, voxels);
    uint32_t bricks = 0;
    const Milliseconds time = median_time([&] {
        bricks = place(device, objects, world).brick_count;
        device.finish();
    });
    print_time(name, voxels, time, fmt::format("{} bricks", bricks));
    return time;
}

void bench(const Device& device, const Mesh& mesh, int voxels, bool with_peers) {
    const double voxel = longest_side(mesh) / std::max(voxels - 16, 1);
    const GridFrame frame = frame_around(mesh, glm::dvec3(voxel));
    const std::pair<const char*, glm::dmat4> maps[] = {
        {"moved", turned_about_middle(frame, {0, 0, 0}, 1)},
        {"turned", turned_about_middle(frame, {33, 21, 12}, 1)},
        {"halved", turned_about_middle(frame, {33, 21, 12}, 0.5)}};
    Voxelizer voxelizer(device);
    const openvdb::FloatGrid::Ptr theirs = with_peers ? level_set(mesh, voxel) : nullptr;
    for (const Surface surface : {Surface::cubes, Surface::smooth}) {
        const char* name = surface == Surface::cubes ? "cubes" : "smooth";
        const BrickGrid grid = voxelizer.voxelize(mesh, glm::dmat4(1), frame, {.surface = surface});
        index_model(device, grid, name, voxels);
        for (const auto& [change, map] : maps) {
            const Milliseconds ours =
                place_model(device, grid, map, fmt::format("place {} {}", name, change), voxels);
            if (!theirs || surface != Surface::smooth) continue;
            const Milliseconds time =
                median_time([&, &m = map] { placed_level_set(*theirs, voxel, m); });
            print_time(fmt::format("OpenVDB {}", change), voxels, time,
                       fmt::format("{:.3g} times our CPU time", time.cpu / ours.cpu));
        }
    }
}

int run(int count, char** words) {
    MeshArguments arguments(count, words);
    if (arguments.voxels.empty()) arguments.voxels = {512};
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
        fmt::print(stderr, "bench_place: {}\n", error.what());
        return 1;
    }
}
