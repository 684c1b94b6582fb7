// SPDX-License-Identifier: Apache-2.0
// Sight rays a second over a field of moving instances of one model, and what moving them takes.
//
//   bench_instances MESH [instances, 1000] [voxels along the model's longest side, 256]
//                   [surface ...]
//
// The instances stand on a square lattice 1 m apart, each 0.85 m long and turned to another side in
// each frame; the observer looks down on them at 55 degrees and sees nothing but the field, 1024 x
// 1024 pixels. Times are the process's CPU time over all threads, so rays are per core; moving is
// the host's own.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <random>

#include "runtime/assets/model_frame.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/render/illumination.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/stages/trace/sight.hpp"
#include "runtime/world/instances.hpp"
#include "runtime/world/world.hpp"
#include "tests/bench/cpu_time.hpp"

namespace voxelume {
namespace {

constexpr int kImage = 1024, kFrames = 9;
constexpr double kLength = 0.85;

/// A map that brings the model's middle to `position` with a random rotation.
glm::dmat4 placement(const Bounds& box, const glm::dvec3& position, std::mt19937& random) {
    std::uniform_real_distribution<double> angle(0, 6.2831853);
    const glm::dvec3 size = box.max - box.min;
    const double scale = kLength / std::max({size.x, size.y, size.z});
    glm::dmat4 map = glm::translate(glm::dmat4(1), position);
    for (int axis = 0; axis < 3; ++axis)
        map = glm::rotate(map, angle(random), glm::dvec3(axis == 0, axis == 1, axis == 2));
    map = glm::scale(map, glm::dvec3(scale));
    return glm::translate(map, -(box.min + box.max) * 0.5);
}

class Field {
  public:
    Field(const std::filesystem::path& mesh, int count, int resolution, const std::string& surface)
        : box_(mesh_bounds(read_mesh(mesh))), side_(int(std::ceil(std::sqrt(count)))) {
        const double half = 0.5 * side_ + 1;
        const double back = 0.35 * side_, up = 0.5 * side_;
        scene =
            parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": {}, "bounds": {{"min": [{}, -1, {}], "max": [{}, 1, {}]}}}},
"models": {{"one": {{"mesh": "{}", "resolution": {}, "surface": "{}"}}}},
"objects": [],
"lights": [],
"observer": {{"position": [0, {}, {}], "look_at": [0, 0, 0],
  "display": {{"shape": "pyramid", "angle": 50, "near": 0.01, "far": {}, "voxels": [8, 8, 8]}}}},
"render": {{"size": [{}, {}]}}}})",
                                    half / 256, -half, -half, half, half, mesh.filename().string(),
                                    resolution, surface, up, -back, 4 * half, kImage, kImage),
                        mesh.parent_path() / "field.json", {});
        Object object;
        object.placement = Placement::instance;
        scene.objects.assign(size_t(count), object);
        scene.models[0].extent = scene.world.bounds;
        move();
    }

    void move() {
        for (size_t i = 0; i < scene.objects.size(); ++i) {
            const glm::dvec3 at(int(i) % side_ - 0.5 * (side_ - 1), 0,
                                int(i) / side_ - 0.5 * (side_ - 1));
            scene.objects[i].world_from_object = placement(box_, at, random_);
        }
    }

    Scene scene;

  private:
    Bounds box_;
    int side_;
    std::mt19937 random_{20261121};
};

void measure(const Device& device, Field& field) {
    WorldReport report;
    Pyramid world = build_world(device, field.scene, report);
    const Features features = features_of(field.scene, world);
    const Camera observer = camera_of(field.scene, world.frame);
    const uint32_t tiles = tile_count(observer.width, observer.height), rays = tiles * 16;
    RayBatch batch = allocate_batch(device, features, rays);
    SightStage sight(device, features, observer);
    Illumination illumination(device, features, field.scene, world, rays);
    std::vector<double> move_seconds, ray_seconds;
    size_t met = 0;
    for (int frame = 0; frame <= kFrames; ++frame) {
        field.move();
        const auto start = std::chrono::steady_clock::now();
        move_instances(device, field.scene, world);
        move_seconds.push_back(
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        device.finish();
        const double moved = cpu_seconds();
        sight.cast(shape_of(world), 0, tiles, batch);
        illumination.find_hits(batch, rays);
        device.finish();
        ray_seconds.push_back(cpu_seconds() - moved);
        const std::vector<uint32_t> voxels =
            batch.hits.read(size_t(VXL_HIT_VOXEL) * batch.stride, batch.stride);
        met = size_t(std::ranges::count_if(voxels, [](uint32_t v) { return v != VXL_NO_VOXEL; }));
    }
    move_seconds.erase(move_seconds.begin());  // warm-up: it builds the kernels
    ray_seconds.erase(ray_seconds.begin());
    fmt::print(
        "{} instances, model of {} voxels, {} lanes: {:.2f} M rays/s per core, {:.0f} % of "
        "them hits, moving {:.2f} ms (least {:.2f})\n",
        report.instances.instances, report.instances.voxels, device.lanes(),
        double(rays) / median_of(ray_seconds) / 1e6, 100.0 * double(met) / double(rays),
        1e3 * median_of(move_seconds),
        1e3 * *std::min_element(move_seconds.begin(), move_seconds.end()));
}

}  // namespace
}  // namespace voxelume

int main(int argc, char** argv) {
    using namespace voxelume;
    if (argc < 2) {
        fmt::print("bench_instances MESH [instances] [voxels] [surface ...]\n");
        return 2;
    }
    const int count = argc > 2 ? std::atoi(argv[2]) : 1000;
    const int resolution = argc > 3 ? std::atoi(argv[3]) : 256;
    std::vector<std::string> surfaces(argv + std::min(argc, 4), argv + argc);
    if (surfaces.empty()) surfaces = {"cubes", "smooth", "exact"};
    const Device device = Device::open("cpu");
    for (const std::string& surface : surfaces) {
        fmt::print("{}: ", surface);
        Field field(argv[1], count, resolution, surface);
        measure(device, field);
    }
}
