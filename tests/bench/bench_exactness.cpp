// SPDX-License-Identifier: Apache-2.0
// Measures the cost of exact arithmetic: the kernels are timed in turns with variants that use only
// floats.
//
//   bench_exactness MESH [voxels along the longest side, 64,512] [turns, 15] [part of a row's name]
//
// Runs every row at each of the sizes, and prints all ratios again at the end.
//
// Traversal: traces sight rays at the mesh. The variant leaves crossings to floats by
// VXL_ARBITRATE=0, and refuses cells that would lie behind so that the walk ends at all.
// Voxelization: runs the supercover's predicates; the variant is tests/bench/float_cover.hpp in
// 32-bit floats. Times are the process's CPU time over all threads; ratios are medians of the
// turns' ratios.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <sstream>

#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/trace/sight.hpp"
#include "runtime/stages/trace/trace.hpp"
#include "runtime/stages/voxelize/mesh_lattice.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"
#include "runtime/stages/voxelize/voxelize_bins.hpp"
#include "runtime/stages/voxelize/voxelize_steps.hpp"
#include "tests/bench/cpu_time.hpp"
#include "tests/bench/float_cover.hpp"

namespace voxelume {
namespace {

/// Prints at once what is being measured, because kernels take seconds to compile.
void tell(const std::string& what) {
    fmt::print(stderr, "{} ...\n", what);
}

/// The settings of a measurement, and its results.
struct Run {
    int turns;
    std::string part;  ///< a part that the names of measured rows contain
    std::vector<std::pair<std::string, double>> ratios;

    bool wants(const std::string& name) const { return name.find(part) != std::string::npos; }
};

/// Prints the medians of both times and of their ratios.
void compare(Run& run, const std::string& name, const std::function<void()>& exact,
             const std::function<void()>& floats) {
    const auto timed = [](const std::function<void()>& work) {
        const double start = cpu_seconds();
        work();
        return cpu_seconds() - start;
    };
    tell(name);
    exact(), floats();  // this also compiles the kernels
    std::vector<double> exact_seconds, float_seconds, ratios;
    for (int turn = 0; turn < run.turns; ++turn) {
        exact_seconds.push_back(timed(exact));
        float_seconds.push_back(timed(floats));
        ratios.push_back(exact_seconds.back() / float_seconds.back());
    }
    fmt::print("{:<24} exact {:8.2f} ms, floats {:8.2f} ms, ratio {:.3f} ({:.3f} to {:.3f})\n",
               name, median_of(exact_seconds) * 1e3, median_of(float_seconds) * 1e3,
               median_of(ratios), *std::ranges::min_element(ratios),
               *std::ranges::max_element(ratios));
    std::fflush(stdout);
    run.ratios.emplace_back(name, median_of(ratios));
}

double longest_side(const Mesh& mesh) {
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
    const glm::vec3 size = high - low;
    return double(std::max({size.x, size.y, size.z}));
}

/// Sight rays of 1024 x 1024 pixels that view a whole pyramid, on its own device.
class Tracing {
  public:
    Tracing(const char* options, const Mesh& mesh, const GridFrame& frame, Surface surface)
        : device_(opened(options)),
          pyramid_(build_index(device_,
                               voxelize_mesh(device_, mesh, glm::dmat4(1), frame, {surface, {}}))),
          stage_(device_, features_of(pyramid_)) {
        constexpr int kSide = 1024;
        Scene scene;
        const glm::dvec3 size = glm::dvec3(frame.size) * frame.voxel_edge;
        const double length = std::max({size.x, size.y, size.z});
        const glm::dvec3 middle = frame.origin + size / 2.0;
        scene.observer.position = middle + length * 1.8 * glm::normalize(glm::dvec3(0.5, 0.35, 1));
        const glm::dvec3 z = glm::normalize(middle - scene.observer.position);
        const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), z));
        scene.observer.world_from_observer = glm::dmat3(x, glm::cross(z, x), z);
        scene.observer.display.half_angles = glm::dvec2(0.3);
        scene.observer.display.far = 100 * length;
        scene.render.size = glm::ivec2(kSide);
        count_ = tile_count(kSide, kSide) * 16;
        batch_.stride = count_;
        batch_.rays = Buffer<float>(device_, "rays", size_t(count_) * VXL_RAY_COMPONENTS);
        batch_.hits = Buffer<uint32_t>(device_, "hits", size_t(count_) * VXL_HIT_COMPONENTS);
        SightStage sight(device_, features_of(pyramid_), camera_of(scene, frame));
        sight.cast(shape_of(pyramid_), 0, tile_count(kSide, kSide), batch_);
        device_.finish();
    }

    void run() {
        stage_.closest(pyramid_, batch_, count_);
        device_.finish();
    }

  private:
    static Device opened(const char* options) {
        setenv("VOXELUME_BUILD_OPTIONS", options, 1);
        setenv("VOXELUME_SELF_TEST", "off", 1);
        const Device device = Device::open();
        unsetenv("VOXELUME_BUILD_OPTIONS");
        unsetenv("VOXELUME_SELF_TEST");
        return device;
    }

    Device device_;
    Pyramid pyramid_;
    TraceStage stage_;
    RayBatch batch_;
    uint32_t count_ = 0;
};

/// The covering of all bricks by triangles that are already binned.
class Covering {
  public:
    Covering(const Device& device, const Mesh& mesh, const GridFrame& frame)
        : device_(device), frame_(frame) {
        const MeshLattice lattice = snap_to_lattice(mesh, glm::dmat4(1), frame);
        const auto* vertices = &lattice.vertices[0].x;
        const auto* corners = &lattice.triangles[0].x;
        triangles_ = {0, uint32_t(lattice.triangles.size()),
                      Buffer<int32_t>(device, "lattice vertices",
                                      std::span(vertices, 3 * lattice.vertices.size())),
                      Buffer<uint32_t>(device, "lattice triangles",
                                       std::span(corners, 3 * lattice.triangles.size()))};
        bins_ = bin_triangles(device, Program(device, "voxelize/voxelize_bin.cl"), triangles_,
                              frame.bricks(), glm::ivec3(0), kBrickSize * kLatticePerVoxel);
        occupancy_ = Buffer<uint64_t>(device, "occupancy", size_t(64) * bins_.stored);
    }

    std::function<void()> work(const Program& program) {
        return [this, kernel = program.kernel("cover_bricks")]() mutable {
            for (int i = 0; i < 4; ++i)
                kernel.launch(WorkItem::heavy, bins_.stored, bins_.stored,
                              glm::ivec4(frame_.size, 0), glm::ivec4(frame_.bricks(), 0),
                              triangles_, bins_, occupancy_);
            device_.finish();
        };
    }

    std::vector<uint64_t> occupancy() const { return occupancy_.read(); }

  private:
    Device device_;
    GridFrame frame_;
    DeviceTriangles triangles_;
    TriangleBins bins_;
    Buffer<uint64_t> occupancy_;
};

uint64_t differing_bits(const std::vector<uint64_t>& a, const std::vector<uint64_t>& b) {
    uint64_t count = 0;
    for (size_t i = 0; i < a.size(); ++i) count += uint64_t(std::popcount(a[i] ^ b[i]));
    return count;
}

void measure_walks(Run& run, const Mesh& mesh, const GridFrame& frame, int resolution) {
    const std::pair<const char*, Surface> surfaces[] = {
        {"cubes", Surface::cubes}, {"smooth", Surface::smooth}, {"exact", Surface::exact}};
    for (const auto& [surface_name, surface] : surfaces) {
        const std::string name = fmt::format("trace {} {}", surface_name, resolution);
        if (!run.wants(name)) continue;
        tell("voxels of " + name);
        Tracing exact("", mesh, frame, surface);
        Tracing floats("-DVXL_ARBITRATE=0", mesh, frame, surface);
        compare(
            run, name, [&] { exact.run(); }, [&] { floats.run(); });
    }
}

void measure_covering(Run& run, const Mesh& mesh, const GridFrame& frame, int resolution) {
    const std::string name = fmt::format("voxelize supercover {}", resolution);
    if (!run.wants(name)) return;
    const Device device = Device::open();
    Covering covering(device, mesh, frame);
    const auto exact = covering.work(Program(device, "voxelize/voxelize_cover.cl",
                                             {{"VXL_SLICES", kBrickSize}, {"VXL_THIN", 0}}));
    const auto floats =
        covering.work(Program::from_text(device, kFloatCover, {{"VXL_SLICES", kBrickSize}}));
    compare(run, name, exact, floats);
    exact();
    const std::vector<uint64_t> right = covering.occupancy();
    floats();
    fmt::print("voxels that floats have wrong: {}\n", differing_bits(right, covering.occupancy()));
}

/// The numbers in a text such as "64,512".
std::vector<int> numbers_of(const std::string& text) {
    std::vector<int> numbers;
    std::istringstream stream(text);
    for (std::string item; std::getline(stream, item, ',');) {
        numbers.push_back(std::atoi(item.c_str()));
        if (numbers.back() < 2)
            throw std::runtime_error("sizes are numbers of voxels, like 64,512");
    }
    return numbers;
}

void measure(const Mesh& mesh, const std::vector<int>& resolutions, Run run) {
    for (const int resolution : resolutions) {
        const GridFrame frame = frame_around(mesh, glm::dvec3(longest_side(mesh) / resolution));
        measure_walks(run, mesh, frame, resolution);
        measure_covering(run, mesh, frame, resolution);
    }
    fmt::print("\nmedians of {} turns, exact over floats:\n", run.turns);
    for (const auto& [name, ratio] : run.ratios) fmt::print("{:<24} {:.3f}\n", name, ratio);
}

}  // namespace
}  // namespace voxelume

int main(int argc, char** argv) {
    try {
        if (argc < 2) throw std::runtime_error("give a mesh");
        const int turns = argc > 3 ? std::atoi(argv[3]) : 15;
        if (turns < 1) throw std::runtime_error("there is at least one turn");
        voxelume::measure(voxelume::read_mesh(argv[1]),
                          voxelume::numbers_of(argc > 2 ? argv[2] : "64,512"),
                          {turns, argc > 4 ? argv[4] : "", {}});
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_exactness: %s\n", error.what());
        return 1;
    }
}
