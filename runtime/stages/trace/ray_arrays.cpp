// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/trace/ray_arrays.hpp"

#include <algorithm>

#include "kernels/shared/texture.h"

namespace voxelume {
namespace {

/// At a later depth, the rays of 1 / kFollowedPart of a batch's surface points are followed
/// together, or of kFollowedPoints if that is more. With two rays each and all features, a depth
/// takes about 300 bytes a ray: 10 MB on a CPU.
constexpr uint32_t kFollowedPart = 4;
constexpr uint32_t kFollowedPoints = 1u << 14;

constexpr const char* kFewerRays =
    "render a smaller image, or with fewer samples a pixel or less depth";

/// Allocates arrays with `slots` slots on a device.
class ArrayMaker {
  public:
    ArrayMaker(const Device& device, uint32_t slots) : device_(device), slots_(slots) {}

    template <class T>
    void make(Buffer<T>& array, const char* name, size_t components) {
        array = Buffer<T>(device_, name, size_t(slots_) * components, kFewerRays);
    }

  private:
    const Device& device_;
    uint32_t slots_;
};

size_t path_components(const Features& features) {
    const size_t emitter = features.looks() ? 1 : 0;
    const bool finds_light = features.emitters != 0 || features.area_shares;
    const size_t travelled = features.instances && finds_light ? 1 : 0;
    const size_t density = features.area_shares ? 1 : 0;
    const size_t width = features.textures() && features.radiance ? 1 : 0;
    if (features.transmission)
        return VXL_PATH_INSIDE + size_t(std::max(features.media, 1)) + emitter + travelled +
               density + width;
    const bool has_all = features.instances || features.global || width > 0;
    return (has_all ? VXL_PATH_INSIDE : VXL_PATH_CELL) + emitter + density + width;
}

size_t hit_components(const Features& features) {
    if (features.instances) return VXL_HIT_COMPONENTS;
    return features.exact() ? VXL_HIT_INSTANCE : VXL_HIT_PRIMITIVE;
}

void make_queue(const Features& features, ArrayMaker& maker, RayQueue& queue) {
    maker.make(queue.rays, "rays", VXL_RAY_COMPONENTS);
    if (!features.paths) return;
    maker.make(queue.paths, "paths", path_components(features));
    if (!features.transmission) return;
    maker.make(queue.starts, "path starts", 1);
    maker.make(queue.inside, "path media", 1);
}

void make_batch(const Features& features, ArrayMaker& maker, RayBatch& batch) {
    make_queue(features, maker, batch);
    maker.make(batch.hits, "hits", hit_components(features));
    if (features.positions) maker.make(batch.positions, "positions", 3);
    if (features.normals) maker.make(batch.normals, "normals", 3);
    if (features.normals && features.shading_normals()) maker.make(batch.shading, "shading", 6);
    if (features.hit_attributes) maker.make(batch.hit_attributes, "hit attributes", 1);
    if (!features.radiance) return;
    maker.make(batch.radiance, "radiance", 3);
    if (features.paths) maker.make(batch.sides, "sides", 1);
    if (features.paths && features.absorbs) maker.make(batch.transmittance, "transmittance", 3);
    if (features.transmission) maker.make(batch.coverage, "coverage", 1);
    if (features.textures())
        maker.make(batch.paint, "paint", VXL_PAINT_FLOATS(features.texture_maps));
}

bool has_shadow_queue(const Features& features) {
    return features.shadows || features.medium;
}

void make_shadow_queue(const Features& features, ArrayMaker& maker, ShadowQueue& queue) {
    maker.make(queue.rays, "shadow queue", VXL_RAY_COMPONENTS);
    maker.make(queue.targets, "shadow queue", 1);
    if (features.sources()) maker.make(queue.sources, "shadow queue", 1);
    maker.make(queue.contributions, "shadow queue", 3);
}

void make_depth(const Features& features, bool is_first, ArrayMaker& maker, PathDepth& depth) {
    const bool has_nodes = features.transmission || features.global;
    if (has_nodes || !is_first) make_batch(features, maker, depth.entries);
    if (has_nodes) {
        make_queue(features, maker, depth.next);
        maker.make(depth.nodes.radiance, "node light", 3);
    }
    if (features.looks()) {
        make_batch(features, maker, depth.to_emitters);
        make_queue(features, maker, depth.next_to_emitters);
    }
    if (features.scattering) {
        make_queue(features, maker, depth.points);
        maker.make(depth.points.hits, "medium points", hit_components(features));
        maker.make(depth.points.radiance, "medium points", 3);
    }
    if (features.transmission && is_first) maker.make(depth.nodes.coverage, "node coverage", 1);
    if (features.global) return;
    if (features.transmission) maker.make(depth.children.node_weights, "path node weights", 3);
    maker.make(depth.children.nodes, "path children", branches_of(features));
    maker.make(depth.children.child_weights, "path child weights",
               branches_of(features) + (features.tinted ? 3 : 0));
}

}  // namespace

uint32_t batch_tiles(const Device& device, const Features& features, int samples,
                     uint32_t maximum) {
    return std::clamp(batch_rays(device, features) / (16 * uint32_t(samples)), 1u, maximum);
}

uint32_t followed_points(uint32_t max_rays, size_t depth) {
    const uint32_t part = std::max(max_rays / kFollowedPart, kFollowedPoints);
    return depth == 0 ? max_rays : std::min(max_rays, part);
}

uint32_t depth_slots(const Features& features, uint32_t max_rays, size_t depth) {
    return branches_of(features) * followed_points(max_rays, depth - 1);
}

RayBatch allocate_batch(const Device& device, const Features& features, uint32_t stride) {
    RayBatch batch;
    batch.stride = stride;
    ArrayMaker maker(device, stride);
    make_batch(features, maker, batch);
    return batch;
}

void renew_sight(const Device& device, RayBatch& batch) {
    batch.rays = Buffer<float>(device, "rays", batch.rays.size(), kFewerRays);
    batch.hits = Buffer<uint32_t>(device, "hits", batch.hits.size(), kFewerRays);
}

ShadowQueue allocate_shadow_queue(const Device& device, const Features& features,
                                  uint32_t max_rays) {
    ShadowQueue queue;
    if (!has_shadow_queue(features)) return queue;
    queue.count = Buffer<uint32_t>(device, "shadow queue", 1);
    if (features.shadows) {
        queue.traced = Buffer<uint32_t>(device, "shadow rays", 2);
        queue.traced.fill(0);
    }
    ArrayMaker maker(device, branches_of(features) * max_rays);
    make_shadow_queue(features, maker, queue);
    return queue;
}

PathDepth allocate_depth(const Device& device, const Features& features, bool is_first,
                         uint32_t slots) {
    PathDepth depth;
    ArrayMaker maker(device, slots);
    make_depth(features, is_first, maker, depth);
    depth.entries.stride = depth.next.stride = depth.nodes.stride = slots;
    depth.to_emitters.stride = depth.next_to_emitters.stride = depth.points.stride = slots;
    return depth;
}

LayerRays allocate_layers(const Device& device, const Features& features, uint32_t slots) {
    LayerRays layers;
    ArrayMaker maker(device, slots);
    make_batch(features, maker, layers.entries);
    make_queue(features, maker, layers.next);
    layers.entries.stride = layers.next.stride = slots;
    return layers;
}

RayArrays allocate_rays(const Device& device, const Features& features, const RayCounts& counts) {
    RayArrays arrays;
    arrays.batch = allocate_batch(device, features, counts.rays);
    if (counts.is_lit) arrays.shadows = allocate_shadow_queue(device, features, counts.rays);
    if (features.paths && features.radiance)
        arrays.depths.push_back(allocate_depth(device, features, true, counts.rays));
    for (size_t depth = 1; depth <= counts.depth; ++depth)
        arrays.depths.push_back(
            allocate_depth(device, features, false, depth_slots(features, counts.rays, depth)));
    return arrays;
}

RayBytes ray_bytes(const Features& features, const RayCounts& counts) {
    const auto bytes_of = [&](size_t depth) {
        const Device device = Device::counting({});
        const RayArrays arrays =
            allocate_rays(device, features, {counts.rays, counts.is_lit, depth});
        return double(device.counters().bytes_in_use);
    };
    RayBytes bytes;
    bytes.once = bytes_of(0);
    bytes.first = bytes_of(1) - bytes.once;
    bytes.per_depth = bytes_of(2) - bytes.once - bytes.first;
    bytes.depth = counts.depth;
    return bytes;
}

double sight_bytes(const Features& features) {
    return 4.0 * double(VXL_RAY_COMPONENTS + hit_components(features));
}

}  // namespace voxelume
