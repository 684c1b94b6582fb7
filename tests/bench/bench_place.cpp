// Run time of placing and indexing, kernels compiled: bench_place MESH-FILE [benchmark options].
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>

#include "runtime/io/mesh_reader.hpp"
#include "runtime/scene_affine.hpp"
#include "runtime/stages/index.hpp"
#include "runtime/stages/place.hpp"
#include "runtime/stages/voxelize.hpp"

namespace voxelume {
namespace {

constexpr int kResolution = 512;

double longest_side(const Mesh& mesh) {
    glm::dvec3 low(mesh.positions.front()), high(low);
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    const glm::dvec3 size = high - low;
    return std::max({size.x, size.y, size.z});
}

/// A world of the object's voxels that holds it however it is turned.
GridFrame world_around(const GridFrame& object) {
    const glm::dvec3 middle = object.origin + object.voxel_edge * glm::dvec3(object.size) * 0.5;
    const glm::ivec3 size(kResolution);
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

struct Model {
    const char* name;
    BrickGrid grid;
};

void place_model(benchmark::State& state, const Device& device, const Model& model,
                 const glm::dmat4& map) {
    const std::vector<PlacedObject> objects = {
        {.grid = &model.grid, .world_from_object = map, .material_of_group = {0}}};
    const GridFrame world = world_around(model.grid.frame);
    const auto once = [&] {
        const BrickGrid placed = place(device, objects, world);
        device.finish();
        return placed.brick_count;
    };
    const uint32_t bricks = once();
    for (auto _ : state) benchmark::DoNotOptimize(once());
    state.counters["bricks"] = bricks;
}

void index_model(benchmark::State& state, const Device& device, const Model& model) {
    const auto once = [&] {
        Pyramid pyramid = build_index(device, model.grid);
        device.finish();
        return pyramid;
    };
    const Pyramid pyramid = once();
    for (auto _ : state) benchmark::DoNotOptimize(once().voxel_count);
    const size_t words = pyramid.bricks.size() + pyramid.leaves.size() +
                         pyramid.leaf_voxels.size() + pyramid.fields.size();
    state.counters["bricks"] = model.grid.brick_count;
    state.counters["voxels"] = pyramid.voxel_count;
    state.counters["bytes/voxel"] = 4.0 * double(words) / double(pyramid.voxel_count);
}

int benchmark_mesh(const char* path, int argc, char** argv) {
    const Device device = Device::open();
    const Mesh mesh = read_mesh(path);
    const GridFrame frame = frame_around(mesh, glm::dvec3(longest_side(mesh) / (kResolution - 16)));
    Voxelizer voxelizer(device);
    const Model models[] = {
        {"cubes", voxelizer.voxelize(mesh, glm::dmat4(1), frame, {.surface = Surface::cubes})},
        {"smooth", voxelizer.voxelize(mesh, glm::dmat4(1), frame, {.surface = Surface::smooth})}};
    const auto add = [](const std::string& name, auto&& run) {
        benchmark::RegisterBenchmark(name.c_str(), run)
            ->Unit(benchmark::kMillisecond)
            ->MeasureProcessCPUTime()
            ->UseRealTime();
    };
    for (const Model& model : models) {
        add(fmt::format("index/{}", model.name),
            [&](benchmark::State& state) { index_model(state, device, model); });
        const auto add_place = [&](const char* name, const glm::dmat4& map) {
            add(fmt::format("place/{}/{}", model.name, name),
                [&, map](benchmark::State& state) { place_model(state, device, model, map); });
        };
        add_place("moved", turned_about_middle(frame, {0, 0, 0}, 1));
        add_place("turned", turned_about_middle(frame, {33, 21, 12}, 1));
        add_place("halved", turned_about_middle(frame, {33, 21, 12}, 0.5));
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}

}  // namespace
}  // namespace voxelume

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fputs("usage: bench_place MESH-FILE [benchmark options]\n", stderr);
        return 2;
    }
    try {
        return voxelume::benchmark_mesh(argv[1], argc - 1, argv + 1);
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench_place: {}\n", error.what());
        return 1;
    }
}
