// SPDX-License-Identifier: Apache-2.0
// Volumetric images of a scene in a Cartesian display: time against a flat image with as many
// shaded points, and memory against stored voxels.
//
//   bench_volume SCENE [voxels along each edge ..., 128 256 512 1024]
//
// The display is a box around the world's middle as the scene's observer sees it, as wide as the
// world is long. The flat image comes from the same box; its size is such that as many pixels hit
// something as the volume has voxels. Both are made five times in turn in this process, after one
// run that compiles the kernels. The minimum times are printed: from building the world on, and for
// the image alone.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "runtime/render/volume_renderer.hpp"
#include "runtime/scene_file/assets.hpp"
#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {
namespace {

constexpr int kRuns = 5;

struct Times {
    double total = 1e9, image = 1e9;
    uint64_t peak = 0;
};

template <class Render>
void time_once(const Device& device, const Render& render, Times& times) {
    RenderReport report;
    device.counters().peak_bytes = device.counters().bytes_in_use;
    const auto start = std::chrono::steady_clock::now();
    render(report);
    const double total =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    times.total = std::min(times.total, total);
    times.image = std::min(times.image, report.image_seconds);
    times.peak = device.counters().peak_bytes;
}

/// The scene with a box display of n³ voxels around the world.
Scene box_scene(Scene scene, int n) {
    const World& world = scene.world;
    const glm::dvec3 middle = 0.5 * (world.bounds.min + world.bounds.max);
    const glm::dvec3 extent = world.bounds.max - world.bounds.min;
    const double half = 0.5 * std::max({extent.x, extent.y, extent.z});
    Display& display = scene.observer.display;
    const double ahead =
        glm::dot(middle - scene.observer.position, scene.observer.world_from_observer[2]);
    scene.observer.position = middle - ahead * scene.observer.world_from_observer[2];
    display = Display{};
    display.shape = DisplayShape::box;
    display.layout = VolumeLayout::lattice;
    display.half_size = glm::dvec2(half);
    display.near = std::max(ahead - half, 0.0);
    display.far = display.near + 2 * half;
    display.voxels = glm::ivec3(n);
    return scene;
}

double share_of_hits(const Image& image) {
    double hits = 0;
    for (const float a : image.planes.at("A")) hits += double(a);
    return hits / double(image.planes.at("A").size());
}

void bench(const Device& device, const Scene& scene, int n) {
    Scene display = box_scene(scene, n);
    RenderReport report;
    const size_t voxels = render_volume(device, display, report).indices.size();
    Scene flat = display;
    flat.render.size = {256, 256};
    const double share = share_of_hits(render(device, flat, report));
    const int side = int(std::lround(std::sqrt(double(voxels) / share)));
    flat.render.size = {side, side};
    Times volume, image;
    for (int run = 0; run < kRuns; ++run) {
        time_once(
            device, [&](RenderReport& r) { render_volume(device, display, r); }, volume);
        time_once(
            device, [&](RenderReport& r) { render(device, flat, r); }, image);
    }
    const double stored = 32.0 * double(voxels), mask = double(n) * n * n / 8;
    fmt::print(
        "{:5}^3 {:9} voxels, {:7.1f} MB stored, mask {:6.1f} MB, peak {:8.1f} MB (flat {:.1f}) | "
        "volume {:6.3f} s, image alone {:6.3f} | flat {}x{} {:6.3f} s, {:6.3f} | ratio "
        "{:.2f}, {:.2f}\n",
        n, voxels, stored / 1e6, mask / 1e6, double(volume.peak) / 1e6, double(image.peak) / 1e6,
        volume.total, volume.image, side, side, image.total, image.image,
        volume.total / image.total, volume.image / image.image);
    std::fflush(stdout);
}

}  // namespace
}  // namespace voxelume

int main(int count, char** arguments) {
    using namespace voxelume;
    if (count < 2) return 2;
    const Device device = Device::open("cpu");
    AssetFolders assets;
    if (const char* folder = std::getenv("VOXELUME_ASSETS")) assets.push_back(folder);
    const Scene scene = read_scene(arguments[1], assets);
    std::vector<int> sizes;
    for (int i = 2; i < count; ++i) sizes.push_back(std::atoi(arguments[i]));
    if (sizes.empty()) sizes = {128, 256, 512, 1024};
    for (const int n : sizes) bench(device, scene, n);
}
