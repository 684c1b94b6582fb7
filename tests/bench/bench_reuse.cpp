// SPDX-License-Identifier: Apache-2.0
// Measures what a frame costs when little has changed: frames one after another against frames
// alone.
//
//   bench_reuse MESH
//
// The mesh, 512 voxels along its longest side and smooth, stands in a world of 512³ voxels, with
// sixty smooth balls. Medians of seven, each change and its full frame in turn.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <vector>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {
namespace {

constexpr int kRuns = 7;

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

Scene scene_of(const std::filesystem::path& mesh, bool with_balls) {
    std::string balls;
    for (int i = 0; with_balls && i < 60; ++i)
        balls +=
            fmt::format(R"(, {{"name": "ball {}", "model": "ball", "position": [{}, {}, {}]}})", i,
                        -0.9 + 0.2 * (i % 10), -0.9 + 0.36 * (i / 10), 0.9);
    const std::string text = fmt::format(
        R"({{"voxelume": 1,
"world": {{"voxel_size": 0.00390625, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}},
           "background": [0.2, 0.3, 0.5], "ambient": [0.1, 0.1, 0.1]}},
"models": {{"mesh": {{"mesh": "{}", "resolution": 512, "surface": "smooth"}},
            "ball": {{"shape": "sphere", "radius": 0.08, "voxel_size": 0.00390625, "surface": "smooth"}}}},
"objects": [{{"name": "mesh", "model": "mesh"}}{}],
"lights": [{{"type": "point", "position": [3, 5, -4], "intensity": 40}}],
"observer": {{"position": [1, 0.7, -3], "look_at": [0, 0, 0],
              "display": {{"shape": "pyramid", "angle": 40, "near": 0.1, "far": 10,
                           "voxels": [1024, 1024, 8]}}}},
"render": {{"size": [1024, 1024]}}}})",
        mesh.filename().string(), balls);
    return parse_scene(text, mesh.parent_path() / "bench.json", {mesh.parent_path()});
}

/// Scales the mesh to fill the world, and moves it to the middle.
void fit(Scene& scene) {
    AssetStore meshes;
    const Bounds box = mesh_bounds(*meshes.mesh_of(scene.models[0]));
    const glm::dvec3 size = box.max - box.min, middle = 0.5 * (box.max + box.min);
    const double scale = 1.9 / std::max({size.x, size.y, size.z});
    for (int axis = 0; axis < 3; ++axis) {
        scene.objects[0].world_from_object[axis][axis] = scale;
        scene.objects[0].world_from_object[3][axis] = -scale * middle[axis];
    }
    scene.models[0].extent = {box.min - size, box.max + size};
}

struct Frame {
    double seconds;
    RenderReport report;
};

/// Renders frames of a scene one after another.
class Frames {
  public:
    explicit Frames(const Device& device) : device_(device), builder_(device), renderer_(device) {}

    Frame render(const Scene& scene) {
        Frame frame{};
        const auto start = std::chrono::steady_clock::now();
        const BuiltWorld world = builder_.build(scene, frame.report.world);
        renderer_.image(scene, world, frame.report);
        device_.finish();
        frame.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return frame;
    }

  private:
    Device device_;
    WorldBuilder builder_;
    Renderer renderer_;
};

/// Times the frame that `change` makes of the previous one, and that frame rendered alone.
void measure(const Device& device, const Scene& first, const char* what,
             const std::function<void(Scene&, int)>& change) {
    std::vector<double> times, alone_times, indices, places, alone_places, shares;
    Frames frames(device);
    frames.render(first);
    for (int run = 0; run < kRuns; ++run) {
        Scene scene = first;
        change(scene, run);
        const Frame frame = frames.render(scene);
        const Frame alone = Frames(device).render(scene);
        times.push_back(frame.seconds), alone_times.push_back(alone.seconds);
        indices.push_back(frame.report.world.index_seconds);
        places.push_back(frame.report.world.place_seconds);
        alone_places.push_back(alone.report.world.place_seconds);
        shares.push_back(double(frame.report.world.painted_bricks) /
                         double(alone.report.world.painted_bricks));
    }
    fmt::print("{:<22} {:>8.1f} ms, alone {:>8.1f} ms: {:.3f}; index {:.1f} ms", what,
               median(times) * 1e3, median(alone_times) * 1e3, median(times) / median(alone_times),
               median(indices) * 1e3);
    if (median(shares) > 0)
        fmt::print("; place {:.1f} ms for {:.3f} of the bricks, all {:.1f} ms: {:.2f} of the share",
                   median(places) * 1e3, median(shares), median(alone_places) * 1e3,
                   median(places) / median(alone_places) / median(shares));
    fmt::print("\n");
}

void run(const std::filesystem::path& mesh) {
    const Device device = Device::open("cpu");
    for (const bool with_balls : {false, true}) {
        Scene scene = scene_of(mesh, with_balls);
        fit(scene);
        fmt::print("{}{}\n", mesh.filename().string(), with_balls ? " and sixty balls" : "");
        measure(device, scene, "nothing", [](Scene&, int) {});
        measure(device, scene, "a light moves",
                [](Scene& s, int run) { s.lights[0].position.x += 0.1 * (run + 1); });
        measure(device, scene, "a colour changes",
                [](Scene& s, int run) { s.materials[0].color = glm::vec3(0.1f * float(run + 1)); });
        measure(device, scene, "the observer moves",
                [](Scene& s, int run) { s.observer.position.x += 0.01 * (run + 1); });
        measure(device, scene, "the mesh moves", [](Scene& s, int run) {
            s.objects[0].world_from_object[3].x += 0.003 * (run + 1);
        });
        if (with_balls)
            measure(device, scene, "a ball moves", [](Scene& s, int run) {
                s.objects[7].world_from_object[3].x += 0.003 * (run + 1);
            });
    }
}

}  // namespace
}  // namespace voxelume

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "usage: bench_reuse MESH\n");
        return 2;
    }
    voxelume::run(argv[1]);
}
