// SPDX-License-Identifier: Apache-2.0
// The arrays that a batch of sight rays fills as it passes through the stages.
#pragma once

#include "kernels/shared/light_beams.h"
#include "kernels/shared/trace.h"
#include "runtime/opencl/buffer.hpp"
#include "runtime/opencl/program.hpp"

namespace voxelume {

/// Rays before they are traced. shared/trace.h has their components, which are `stride` values
/// apart.
struct RayQueue {
    Buffer<float> rays;  ///< VXL_RAY_COMPONENTS
    // only in scenes with paths:
    Buffer<uint32_t> paths;   ///< VXL_PATH_*; the last component is repeated for each medium of the
                              ///< set
    Buffer<float> starts;     ///< t at which the ray's segment begins
    Buffer<uint32_t> inside;  ///< 0: environment; else 1 + the material that the ray passes through
    uint32_t stride = 0;      ///< room for this many rays, a multiple of 16
};

/// VXL_QUEUE_PARAMETERS of kernels.
void bind(KernelArguments& to, const RayQueue& queue);

/// VXL_COUNTED_QUEUE_PARAMETERS of kernels.
struct CountedQueue {
    const Buffer<uint32_t>& counters;  ///< kPathCounters of them
    const RayQueue& queue;
};
void bind(KernelArguments& to, const CountedQueue& counted);

/// Rays and their hits.
struct RayBatch : RayQueue {
    Buffer<uint32_t> beams;   ///< VXL_BEAM_COMPONENTS, for sight rays; empty if no beams were sent
    Buffer<uint32_t> hits;    ///< VXL_HIT_COMPONENTS
    Buffer<float> positions;  ///< 3 per hit, voxels
    Buffer<float> normals;    ///< 3 per hit: unit vectors in metric space that point towards the
                              ///< ray's start
    Buffer<float> shading;    ///< 6 per hit, of scenes with shading normals: the unit vector in
                              ///< metric space by which light falls, and by how many metres rays
                              ///< to lights begin off the hit
    Buffer<uint32_t> hit_attributes;  ///< the packed attributes of each hit
    Buffer<float> radiance;           ///< 3
    // only in scenes with paths:
    Buffer<uint32_t> sides;       ///< VXL_SIDE_* bits: which side of the surface each ray met
    Buffer<float> transmittance;  ///< 3: the part of the light that passes through the segment
    Buffer<float> coverage;       ///< the part of what lies behind that is covered
    // only in scenes with textures:
    Buffer<float> paint;  ///< VXL_PAINT_FLOATS, hit by hit: see shared/texture.h
};

/// VXL_BATCH_PARAMETERS of kernels.
void bind(KernelArguments& to, const RayBatch& batch);

/// The distance from a light within which the world is empty, see light_beams.cl; no columns if
/// unknown.
struct LightBeams {
    BeamGrid grid{};
    Buffer<float> ends;
};

/// Shadow rays that wait to be traced, left-packed. Not allocated if nothing can block light.
struct ShadowQueue {
    Buffer<uint32_t> count;       ///< one value, kept on the device
    Buffer<uint32_t> traced;      ///< the number of rays traced since the frame began: low 32 bits,
                                  ///< high 32 bits; only with shadows
    Buffer<float> rays;           ///< VXL_RAY_COMPONENTS, the batch's stride apart
    Buffer<uint32_t> targets;     ///< the sight ray whose radiance each shadow ray would add to
    Buffer<uint32_t> sources;     ///< the primitive that each begins on; only for exact surfaces
    Buffer<float> contributions;  ///< 3: the light that arrives if nothing is in the way
    LightBeams beams;             ///< the beams of the light that they run to
};

/// VXL_SHADOW_QUEUE_PARAMETERS of kernels.
void bind(KernelArguments& to, const ShadowQueue& queue);

}  // namespace voxelume
