// Run time of voxelization, kernels compiled: bench_voxelize MESH-FILE [benchmark options].
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "runtime/io/mesh_reader.hpp"
#include "runtime/stages/voxelize.hpp"

namespace voxelume {
namespace {

struct Case {
    const char* name;
    VoxelizeOptions options;
    int resolution;  ///< voxels along the longest side
};

double longest_side(const Mesh& mesh) {
    glm::dvec3 low(mesh.positions.front()), high(low);
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    const glm::dvec3 size = high - low;
    return std::max({size.x, size.y, size.z});
}

void run(benchmark::State& state, Voxelizer& voxelizer, const Device& device, const Mesh& mesh,
         const Case& c) {
    const GridFrame frame = frame_around(mesh, glm::dvec3(longest_side(mesh) / c.resolution));
    const auto once = [&] {
        const BrickGrid grid = voxelizer.voxelize(mesh, glm::dmat4(1), frame, c.options);
        device.finish();
        return grid.brick_count;
    };
    const uint32_t bricks = once();
    for (auto _ : state) benchmark::DoNotOptimize(once());
    state.counters["bricks"] = bricks;
    state.counters["triangles"] = double(mesh.triangles.size());
}

int benchmark_mesh(const char* path, int argc, char** argv) {
    const Device device = Device::open();
    const Mesh mesh = read_mesh(path);
    Voxelizer voxelizer(device);
    std::vector<Case> cases;
    for (const int n : {128, 256, 512, 1024}) {
        cases.push_back({"supercover", {Surface::cubes, VoxelSet::supercover}, n});
        cases.push_back({"thin", {Surface::cubes, VoxelSet::thin}, n});
        cases.push_back({"solid", {Surface::cubes, VoxelSet::solid}, n});
        cases.push_back({"smooth", {Surface::smooth}, n});
        cases.push_back({"exact", {Surface::exact}, n});
    }
    for (const Case& c : cases)
        benchmark::RegisterBenchmark(
            fmt::format("{}/{}", c.name, c.resolution).c_str(),
            [&, c](benchmark::State& state) { run(state, voxelizer, device, mesh, c); })
            ->Unit(benchmark::kMillisecond)
            ->MeasureProcessCPUTime()
            ->UseRealTime();
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}

}  // namespace
}  // namespace voxelume

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: bench_voxelize MESH-FILE [benchmark options]\n");
        return 2;
    }
    try {
        return voxelume::benchmark_mesh(argv[1], argc - 1, argv + 1);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_voxelize: %s\n", error.what());
        return 1;
    }
}
