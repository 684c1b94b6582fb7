// SPDX-License-Identifier: Apache-2.0
// A whole frame by stage, and how it grows with the voxels: a mesh with one light and shadow at
// 1024 x 1024.
//
//   bench_frame [MESH] [voxels along the longest side ... | surfaces ... | frames=N]
//
// Without a mesh it takes Debian's bunny. Each row is one resolution: medians over the frames, each
// from nothing, of the process's CPU time in milliseconds (all threads); with kernels' bytes a
// voxel, and the ratios to the row before. A first frame, which isn't counted, builds the programs.
// "ns a ray" counts only the kernels of sight and shadow rays, in wall time with one PoCL thread:
// set POCL_MAX_PTHREAD_COUNT=1.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/bench/mesh_rows.hpp"

namespace voxelume {
namespace {

/// The set-up of bench_trace: the mesh's longest side is 1 m, and its middle is the origin.
Scene scene_of(const std::filesystem::path& mesh, const std::string& surface, int voxels) {
    const std::string text = fmt::format(
        R"({{"voxelume": 1,
"world": {{"voxel_size": {0}, "bounds": {{"min": [-0.51, -0.51, -0.51], "max": [0.51, 0.51, 0.51]}},
           "ambient": [0.1, 0.1, 0.1]}},
"models": {{"m": {{"mesh": "{1}", "surface": "{2}", "resolution": {3}}}}},
"objects": [{{"model": "m"}}],
"lights": [{{"type": "point", "position": [1.5, 2.5, 2], "intensity": 8}}],
"observer": {{"position": [0.7695, 0.5386, 1.5389], "look_at": [0, 0, 0],
              "display": {{"shape": "pyramid", "angle": 40}}}},
"render": {{"size": [1024, 1024]}}}})",
        1.0 / voxels, mesh.filename().string(), surface, voxels);
    const std::filesystem::path folder = mesh.parent_path();
    Scene scene = parse_scene(text, (folder.empty() ? "." : folder) / "s.json", {});
    AssetStore meshes;
    const Bounds box = meshes.summary_of(scene.models[0])->surface;
    const glm::dvec3 size = box.max - box.min, middle = (box.min + box.max) * 0.5;
    const double scale = 1 / std::max({size.x, size.y, size.z});
    glm::dmat4& map = scene.objects[0].world_from_object;
    map = glm::dmat4(scale);
    map[3] = glm::dvec4(-scale * middle, 1);
    scene.models[0].resolution = 0;
    scene.models[0].voxel_size = glm::dvec3(1.0 / voxels / scale);
    return scene;
}

struct Sample {
    double form = 0, image = 0;  ///< CPU seconds
    RenderReport report;
    double rays_ms = 0;  ///< the time of the kernels that follow rays
    uint64_t peak = 0;   ///< bytes on the device
};

Sample frame(const Device& device, const Scene& scene) {
    Sample sample;
    device.counters() = {};
    device.time_kernels(true);
    const double start = cpu_seconds();
    const BuiltWorld world = WorldBuilder(device, false).build(scene, sample.report.world);
    device.finish();
    sample.form = cpu_seconds() - start;
    Renderer(device, false).new_image(scene, world, sample.report);
    device.finish();
    sample.image = cpu_seconds() - start - sample.form;
    for (const char* kernel : {"start_beams", "trace_closest", "trace_shadows"})
        sample.rays_ms += device.counters().kernel_ms[kernel];
    sample.peak = device.counters().peak_bytes;
    return sample;
}

double median(const std::vector<Sample>& samples, auto&& value) {
    std::vector<double> values;
    for (const Sample& sample : samples) values.push_back(value(sample));
    return median_of(std::move(values));
}

void bench(const std::string& mesh, const std::string& surface, const std::vector<int>& voxels,
           int frames) {
    const Device device = Device::open();
    double before[4] = {};
    for (const int n : voxels) {
        const Scene scene = scene_of(mesh, surface, n);
        frame(device, scene);
        std::vector<Sample> samples;
        for (int i = 0; i < frames; ++i) samples.push_back(frame(device, scene));
        const RenderReport& report = samples[0].report;
        const double rays = double(report.sight_rays + report.shadow_rays);
        const auto seconds = [&](auto field) {
            return 1e3 * median(samples, [&](const Sample& s) { return s.report.world.*field; });
        };
        const double values[4] = {
            median(samples, [&](const Sample& s) { return s.rays_ms * 1e6 / rays; }),
            1e3 * median(samples, [](const Sample& s) { return s.form; }),
            double(samples[0].peak) / 1e6, double(report.world_bytes) / 1e6};
        fmt::print("{:7}{:6}{:11}{:8.2f}{:9.1f}{:8.1f}{:8.1f}{:8.1f}{:8.1f}{:9.1f}{:9.1f}{:8.1f}",
                   surface, n, report.voxels, values[3] * 1e6 / double(report.voxels), values[1],
                   seconds(&WorldReport::load_seconds), seconds(&WorldReport::voxelize_seconds),
                   seconds(&WorldReport::place_seconds), seconds(&WorldReport::index_seconds),
                   1e3 * median(samples, [](const Sample& s) { return s.image; }), values[2],
                   values[0]);
        if (before[0] > 0)
            fmt::print("   x{:.2f} ray, x{:.2f} forming, x{:.2f} peak, x{:.2f} world",
                       values[0] / before[0], values[1] / before[1], values[2] / before[2],
                       values[3] / before[3]);
        fmt::print("\n");
        std::fflush(stdout);
        std::ranges::copy(values, before);
    }
}

int run(int count, char** arguments) {
    std::vector<int> voxels;
    std::vector<std::string> surfaces;
    std::string mesh = kDebianBunny;
    int frames = 5;
    for (int i = 1; i < count; ++i) {
        const std::string word = arguments[i];
        if (word.starts_with("frames="))
            frames = std::max(1, std::atoi(word.c_str() + 7));
        else if (std::atoi(word.c_str()) > 0)
            voxels.push_back(std::atoi(word.c_str()));
        else if (word.find('.') != std::string::npos)
            mesh = word;
        else
            surfaces.push_back(word);
    }
    if (voxels.empty()) voxels = {256, 512, 1024};
    if (surfaces.empty()) surfaces = {"cubes", "smooth", "exact"};
    fmt::print("{:7}{:>6}{:>11}{:>8}{:>9}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>8}\n", "", "n", "voxels",
               "bytes", "form CPU", "load", "voxels", "place", "index", "image", "peak MB",
               "ns/ray");
    for (const std::string& surface : surfaces) bench(mesh, surface, voxels, frames);
    return 0;
}

}  // namespace
}  // namespace voxelume

int main(int count, char** arguments) {
    try {
        return voxelume::run(count, arguments);
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench_frame: {}\n", error.what());
        return 1;
    }
}
