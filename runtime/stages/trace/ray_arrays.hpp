// features -> the arrays of rays on their way through the stages, and the memory that they take.
//
// What is planned is allocated on a counting device.
#pragma once

#include <vector>

#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/trace/scatter.hpp"

namespace voxelume {

/// The arrays of one depth of paths.
struct PathDepth {
    RayBatch entries;
    RayQueue next;  ///< the layer behind them
    Children children;
    NodeLight nodes;
};

/// Rays that go through the stages together.
inline uint32_t batch_rays(const Features& features) {
    return features.paths ? kBatchRays / 2 : kBatchRays;
}

/// Tiles of 4 x 4 pixels whose rays do, with so many samples a pixel; 1 to `maximum`.
uint32_t batch_tiles(const Features& features, int samples, uint32_t maximum);

/// Rays that a surface point may send on.
inline uint32_t branches_of(const Features& features) {
    return features.refracts ? 2 : 1;
}

/// An empty batch for up to `stride` rays, with the arrays that the features need.
RayBatch allocate_batch(const Device& device, const Features& features, uint32_t stride);

/// Gives the batch other arrays for its rays and hits; whoever holds the old ones keeps them.
void renew_sight(const Device& device, RayBatch& batch);

/// For the shadow rays of batches of at most `max_rays` and of what these send on. Empty where
/// nothing can keep light back.
ShadowQueue allocate_shadow_queue(const Device& device, const Features& features,
                                  uint32_t max_rays);

/// For `slots` nodes of a depth. The observer's own rays, the first depth, are the caller's.
PathDepth allocate_depth(const Device& device, const Features& features, bool is_first,
                         uint32_t slots);

/// Places of a later depth in which `count` nodes are kept.
uint32_t depth_slots(uint32_t count);

/// Bytes that rays take on a device.
struct RayBytes {
    double once = 0;       ///< for the observer's rays and their shadow rays
    double per_depth = 0;  ///< for what is reflected and refracted, of each depth
    size_t depth = 0;      ///< of those, at most

    /// With the first depth, whose arrays are made whatever is met.
    double minimum() const { return once + (depth > 0 ? per_depth : 0); }
    double maximum() const { return once + per_depth * double(depth); }
};

/// Sight rays that go together, which are reflected or refracted up to `depth` times, in a scene
/// with lights or without.
struct RayCounts {
    uint32_t rays = 0;
    bool is_lit = false;
    size_t depth = 0;
};

/// All arrays that they may need.
struct RayArrays {
    RayBatch batch;
    ShadowQueue shadows;
    std::vector<PathDepth> depths;
};
RayArrays allocate_rays(const Device& device, const Features& features, const RayCounts& counts);

/// What these arrays take.
RayBytes ray_bytes(const Features& features, const RayCounts& counts);

/// Bytes of a sight ray and its hit.
double sight_bytes(const Features& features);

}  // namespace voxelume
