#include "runtime/renderer.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

#include "runtime/stages/light.hpp"
#include "runtime/stages/resolve.hpp"
#include "runtime/stages/shade.hpp"
#include "runtime/stages/sight.hpp"
#include "runtime/stages/trace.hpp"

namespace voxelume {
namespace {

/// Rays that go through the stages together: enough to fill any device, few enough to stay in a
/// CPU's caches on their way (measured with bench_frame; 2^16 to 2^19 differ by less than 5 %).
constexpr uint32_t kBatchRays = 1u << 18;

bool has_light(const Scene& scene) {
    return std::ranges::any_of(scene.lights,
                               [](const Light& light) { return light.energy != glm::vec3(0); });
}

Features features_of(const Scene& scene, const Pyramid& world) {
    Features features = features_of(world);
    features.shadows = scene.render.shadows && has_light(scene);
    features.medium = scene.world.medium.absorption != glm::vec3(0);
    return features;
}

RayBatch allocate_batch(const Device& device, const Features& features, uint32_t stride) {
    RayBatch batch;
    batch.stride = stride;
    batch.rays = Buffer<float>(device, "rays", size_t(stride) * VXL_RAY_COMPONENTS);
    const size_t hit_components = features.exact() ? VXL_HIT_COMPONENTS : VXL_HIT_PRIMITIVE;
    batch.hits = Buffer<uint32_t>(device, "hits", stride * hit_components);
    batch.positions = Buffer<float>(device, "positions", size_t(stride) * 3);
    batch.normals = Buffer<float>(device, "normals", size_t(stride) * 3);
    batch.words = Buffer<uint32_t>(device, "words", stride);
    batch.radiance = Buffer<float>(device, "radiance", size_t(stride) * 3);
    return batch;
}

ShadowQueue allocate_queue(const Device& device, const Features& features, uint32_t stride) {
    ShadowQueue queue;
    if (!features.shadows) return queue;
    queue.count = Buffer<uint32_t>(device, "shadow queue", 1);
    queue.rays = Buffer<float>(device, "shadow queue", size_t(stride) * VXL_RAY_COMPONENTS);
    queue.targets = Buffer<uint32_t>(device, "shadow queue", stride);
    if (features.exact()) queue.sources = Buffer<uint32_t>(device, "shadow queue", stride);
    queue.shares = Buffer<float>(device, "shadow queue", size_t(stride) * 3);
    return queue;
}

std::vector<LightRecord> light_records(const Scene& scene, const GridFrame& world) {
    std::vector<LightRecord> records;
    for (const Light& light : scene.lights)
        if (light.energy != glm::vec3(0)) records.push_back(light_record(light, world));
    return records;
}

}  // namespace

Image render(const Device& device, const Scene& scene, RenderReport& report,
             const std::function<void(uint32_t, uint32_t)>& progress) {
    const Pyramid world = form_world(device, scene, report.world);
    const auto start = std::chrono::steady_clock::now();
    const Features features = features_of(scene, world);
    const Sight observer = sight_of(scene, world.frame);
    const std::vector<LightRecord> lights = light_records(scene, world.frame);

    SightStage sight(device, features, observer);
    TraceStage trace(device, features);
    ShadeStage shade(device, features, scene);
    std::optional<LightStage> lighting;  // not even compiled in a scene without lights
    if (!lights.empty()) lighting.emplace(device, features, shade.space(), shade.materials());
    ResolveStage resolve(device, features, observer);

    const uint32_t tiles = tile_count(observer.width, observer.height);
    const uint32_t rays_per_tile = 16 * uint32_t(observer.samples);
    const uint32_t batch_tiles = std::clamp(kBatchRays / rays_per_tile, 1u, tiles);
    RayBatch batch = allocate_batch(device, features, batch_tiles * rays_per_tile);
    ShadowQueue queue = allocate_queue(device, features, batch.stride);

    for (uint32_t first = 0; first < tiles; first += batch_tiles) {
        const uint32_t now = std::min(batch_tiles, tiles - first);
        const uint32_t rays = sight.cast(shape_of(world), first, now, batch);
        trace.closest(world, batch, rays);
        shade.surface(world, batch, rays);
        for (const LightRecord& light : lights) {
            lighting->add(world, light, batch, rays, queue);
            if (features.shadows) trace.shadows(world, queue, rays, batch.stride, batch.radiance);
        }
        if (features.medium) resolve.absorb(world, shade.space(), batch, rays);
        resolve.pixels(world, batch, first, now);
        report.sight_rays += rays;
        if (progress) {
            device.finish();
            progress(first + now, tiles);
        }
    }
    Image image = resolve.image();
    report.not_finite = resolve.not_finite();
    report.voxels = world.voxel_count;
    report.image_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return image;
}

}  // namespace voxelume
