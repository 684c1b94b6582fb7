// SPDX-License-Identifier: Apache-2.0
// The arrays of a batch of rays as kernels take them; runtime/stages/ray_batch.hpp describes them.
// A kernel that needs three or more of a structure's arrays takes the whole structure.
#ifndef VXL_RAY_BATCH_H
#define VXL_RAY_BATCH_H

#include "shared/light_beams.h"
#include "shared/trace.h"

/// The parameters that `bind` of a RayBatch sets, in its order.
#define VXL_BATCH_PARAMETERS                                                                 \
    global float *restrict rays, global uint *restrict paths, global float *restrict starts, \
        global uint *restrict inside, uint stride, global uint *restrict beams,              \
        global uint *restrict hits, global float *restrict positions,                        \
        global float *restrict normals, global float *restrict shading,                      \
        global uint *restrict hit_attributes, global float *restrict radiance,               \
        global uint *restrict sides, global float *restrict transmittance,                   \
        global float *restrict coverage, global float *restrict paint

/// Rays and what they met. Arrays that a scene doesn't need are null.
typedef struct {
    global float* restrict rays;
    global uint* restrict paths;
    global float* restrict starts;
    global uint* restrict inside;
    uint stride;
    global uint* restrict beams;
    global uint* restrict hits;
    global float* restrict positions;
    global float* restrict normals;
    global float* restrict shading;
    global uint* restrict hit_attributes;
    global float* restrict radiance;
    global uint* restrict sides;
    global float* restrict transmittance;
    global float* restrict coverage;
    global float* restrict paint;
} RayBatch;

/// The value of a RayBatch in a kernel with these parameters.
#define VXL_BATCH                                                                      \
    {                                                                                  \
        rays, paths, starts, inside, stride, beams, hits, positions, normals, shading, \
            hit_attributes, radiance, sides, transmittance, coverage, paint            \
    }

/// The parameters that `bind` of a ShadowQueue sets, in its order.
#define VXL_SHADOW_QUEUE_PARAMETERS                                                        \
    global uint *restrict shadow_count, global uint *restrict shadow_traced,               \
        global float *restrict shadow_rays, global uint *restrict shadow_targets,          \
        global uint *restrict shadow_sources, global float *restrict shadow_contributions, \
        BeamGrid shadow_beam_grid, global const float *restrict shadow_beam_ends

/// Shadow rays that wait to be traced; components are the batch's stride apart.
typedef struct {
    global uint* restrict count;
    global uint* restrict traced;
    global float* restrict rays;
    global uint* restrict targets;
    global uint* restrict sources;
    global float* restrict contributions;
    BeamGrid beam_grid;  // beams of the light that the rays run to
    global const float* restrict beam_ends;
} ShadowQueue;

/// The value of a ShadowQueue in a kernel with these parameters.
#define VXL_SHADOW_QUEUE                                                          \
    {                                                                             \
        shadow_count, shadow_traced, shadow_rays, shadow_targets, shadow_sources, \
            shadow_contributions, shadow_beam_grid, shadow_beam_ends              \
    }

#endif
