#include "runtime/illumination.hpp"

#include <algorithm>

#include "runtime/stages/spots.hpp"

namespace voxelume {
namespace {

bool shines(const Light& light) {
    return light.energy != glm::vec3(0);
}

bool has_area(const Light& light) {
    return light.kind == LightKind::disk || light.kind == LightKind::rectangle;
}

bool has_lamp(const Scene& scene) {
    return std::ranges::any_of(scene.objects,
                               [&](const Object& object) { return is_lamp(scene, object); });
}

bool has_light(const Scene& scene) {
    return std::ranges::any_of(scene.lights, shines) || has_lamp(scene);
}

ShadowQueue allocate_queue(const Device& device, const Features& features, uint32_t stride) {
    ShadowQueue queue;
    if (!features.shadows) return queue;
    queue.count = Buffer<uint32_t>(device, "shadow queue", 1);
    queue.traced = Buffer<uint32_t>(device, "shadow rays", 2);
    queue.traced.fill(0);
    queue.rays = Buffer<float>(device, "shadow queue", size_t(stride) * VXL_RAY_COMPONENTS);
    queue.targets = Buffer<uint32_t>(device, "shadow queue", stride);
    if (features.exact()) queue.sources = Buffer<uint32_t>(device, "shadow queue", stride);
    queue.shares = Buffer<float>(device, "shadow queue", size_t(stride) * 3);
    return queue;
}

std::vector<LightRecord> light_records(const Device& device, const Features& features,
                                       const Scene& scene, const Pyramid& world) {
    std::vector<LightRecord> records;
    for (const Light& light : scene.lights) {
        if (!shines(light)) continue;
        if (has_area(light))
            std::ranges::copy(area_spots(light, world.frame), std::back_inserter(records));
        else
            records.push_back(light_record(light, world.frame));
    }
    if (has_lamp(scene))
        std::ranges::copy(lamp_spots(device, features, scene, world), std::back_inserter(records));
    return records;
}

}  // namespace

Features features_of(const Scene& scene, const Pyramid& world) {
    Features features = features_of(world);
    features.shadows = scene.render.shadows && has_light(scene);
    features.patches = has_lamp(scene) || std::ranges::any_of(scene.lights, [](const Light& light) {
                           return shines(light) && has_area(light);
                       });
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

Illumination::Illumination(const Device& device, const Features& features, const Scene& scene,
                           const Pyramid& world, uint32_t most_rays)
    : features_(features),
      world_(world),
      lights_(light_records(device, features, scene, world)),
      trace_(device, features),
      shade_(device, features, scene),
      queue_(allocate_queue(device, features, most_rays)) {
    if (!lights_.empty()) lighting_.emplace(device, features, shade_.space(), shade_.materials());
    if (features.medium) medium_.emplace(device, features, shade_.space());
}

void Illumination::light(RayBatch& batch, uint32_t count) {
    trace_.closest(world_, batch, count);
    shade_.surface(world_, batch, count);
    for (const LightRecord& light : lights_) {
        lighting_->add(world_, light, batch, count, queue_);
        if (features_.shadows) trace_.shadows(world_, queue_, count, batch.stride, batch.radiance);
    }
    if (medium_) medium_->sight(world_, batch, count);
}

uint64_t Illumination::shadow_rays() const {
    if (queue_.traced.empty()) return 0;
    return queue_.traced.read_one(0) | uint64_t(queue_.traced.read_one(1)) << 32;
}

}  // namespace voxelume
