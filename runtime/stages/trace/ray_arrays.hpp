// SPDX-License-Identifier: Apache-2.0
// features -> the arrays of rays that pass through the stages, and their memory.
//
// Planning allocates the arrays on a counting device.
#pragma once

#include <vector>

#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/trace/scatter.hpp"

namespace voxelume {

/// The arrays of one depth of paths.
struct PathDepth {
    RayBatch entries;
    RayQueue next;              ///< rays of the next layer
    RayBatch to_emitters;       ///< rays from paths to emitters, if any
    RayQueue next_to_emitters;  ///< such rays that continue straight through surfaces
    RayBatch points;  ///< points where the medium scatters paths: the ways there, empty hits, and
                      ///< radiance
    Children children;
    NodeLight nodes;
};

/// The maximum number of rays that pass through the stages of a device together.
inline uint32_t batch_rays(const Device& device, const Features& features) {
    return features.paths ? device.batch_rays() / 2 : device.batch_rays();
}

/// The number of tiles of 4 x 4 pixels whose rays make a batch, with `samples` samples a pixel; 1
/// to `maximum`.
uint32_t batch_tiles(const Device& device, const Features& features, int samples, uint32_t maximum);

/// The maximum number of rays that a surface point spawns.
inline uint32_t branches_of(const Features& features) {
    return features.refracts ? 2 : 1;
}

/// The maximum number of surface points of depth `depth` whose reflected and refracted rays are
/// followed together, in batches of at most `max_rays`. Depth 0 is the observer's. Every later
/// depth has arrays of its own for these rays, so fewer are followed there.
uint32_t followed_points(uint32_t max_rays, size_t depth);

/// An empty batch for up to `stride` rays, with the arrays that the features need.
RayBatch allocate_batch(const Device& device, const Features& features, uint32_t stride);

/// Gives the batch new arrays for its rays and hits; holders of the old arrays keep them.
void renew_sight(const Device& device, RayBatch& batch);

/// The queue for the shadow rays of batches of at most `max_rays` rays, and of the rays that these
/// spawn. Empty if nothing can block light.
ShadowQueue allocate_shadow_queue(const Device& device, const Features& features,
                                  uint32_t max_rays);

/// The arrays for `slots` nodes of one depth. The observer's own rays, the first depth, belong to
/// the caller.
PathDepth allocate_depth(const Device& device, const Features& features, bool is_first,
                         uint32_t slots);

/// The rays that continue straight through surfaces in global light, layer by layer.
struct LayerRays {
    RayBatch entries;
    RayQueue next;  ///< rays of the next layer
};

LayerRays allocate_layers(const Device& device, const Features& features, uint32_t slots);

/// The number of slots of a depth from 1 on: those for all rays that are followed together.
uint32_t depth_slots(const Features& features, uint32_t max_rays, size_t depth);

/// The bytes that rays take on a device.
struct RayBytes {
    double once = 0;       ///< for the observer's rays and their shadow rays
    double first = 0;      ///< for their spawned rays, the first depth
    double per_depth = 0;  ///< for the reflected and refracted rays of each further depth
    size_t depth = 0;      ///< maximum number of depths, the first included

    /// Includes the first depth, whose arrays are made whatever the rays meet.
    double minimum() const { return once + (depth > 0 ? first : 0); }
    double maximum() const { return minimum() + (depth > 1 ? per_depth * double(depth - 1) : 0); }
};

/// Sight rays of one batch, which are reflected or refracted up to `depth` times, and whether the
/// scene has lights.
struct RayCounts {
    uint32_t rays = 0;
    bool is_lit = false;
    size_t depth = 0;
};

/// All arrays for these rays.
struct RayArrays {
    RayBatch batch;
    ShadowQueue shadows;
    std::vector<PathDepth> depths;
};
RayArrays allocate_rays(const Device& device, const Features& features, const RayCounts& counts);

/// The bytes of these arrays.
RayBytes ray_bytes(const Features& features, const RayCounts& counts);

/// The maximum bytes of sight rays and hits that an image retains for the passes of its light.
inline constexpr double kMaxPassHitBytes = double(1u << 30);

/// The bytes of a sight ray and its hit.
double sight_bytes(const Features& features);

}  // namespace voxelume
