// The arrays that a batch of sight rays fills on its way through the stages.
#pragma once

#include "kernels/shared/light_beams.h"
#include "kernels/shared/trace.h"
#include "runtime/opencl/buffer.hpp"

namespace voxelume {

/// Rays that go through the stages together: few enough for a CPU's memory and caches, half of the
/// work-items that the largest GPUs hold at once.
inline constexpr uint32_t kBatchRays = 1u << 17;

/// Rays as they set out; shared/trace.h has the components, `stride` values apart.
struct RayQueue {
    Buffer<float> rays;  ///< VXL_RAY_COMPONENTS
    // of scenes with paths only
    Buffer<uint32_t> paths;   ///< VXL_PATH_*, the last once for each member
    Buffer<float> starts;     ///< t where the ray's segment begins
    Buffer<uint32_t> inside;  ///< 0: open space; else 1 + the material it goes through
};

/// Rays and what they met.
struct RayBatch : RayQueue {
    uint32_t stride = 0;      ///< places for rays, a multiple of 16
    Buffer<uint32_t> beams;   ///< VXL_BEAM_COMPONENTS, of sight rays; empty: no beams were sent
    Buffer<uint32_t> hits;    ///< VXL_HIT_COMPONENTS
    Buffer<float> positions;  ///< 3: of the hits, voxels
    Buffer<float> normals;    ///< 3: unit, in metres' space, towards the ray's start
    Buffer<uint32_t> hit_attributes;  ///< the packed attributes of each hit
    Buffer<float> radiance;           ///< 3
    // of scenes with paths only
    Buffer<uint32_t> sides;       ///< VXL_SIDE_* bits: how each surface was met
    Buffer<float> transmittance;  ///< 3: the part of the light that comes through the segment
    Buffer<float> coverage;       ///< how much of what lies behind is covered
};

/// How far from a light the world is empty, see light_beams.cl; no columns where that isn't known.
struct LightBeams {
    BeamGrid grid{};
    Buffer<float> ends;
};

/// Shadow rays waiting to be traced, left-packed. Not allocated where nothing can keep light back.
struct ShadowQueue {
    Buffer<uint32_t> count;       ///< one value, kept on the device
    Buffer<uint32_t> traced;      ///< rays traced since the frame began: low word, high word; only
                                  ///< with shadows
    Buffer<float> rays;           ///< VXL_RAY_COMPONENTS, the batch's stride apart
    Buffer<uint32_t> targets;     ///< the sight ray whose radiance each would add to
    Buffer<uint32_t> sources;     ///< the primitive that each begins on; exact surfaces only
    Buffer<float> contributions;  ///< 3: the light that arrives if nothing is in the way
    LightBeams beams;             ///< of the light that they run to
};

}  // namespace voxelume
