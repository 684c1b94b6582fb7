// SPDX-License-Identifier: Apache-2.0
// Global light: what the kernels that follow light paths need to know of the image and its lights.
#ifndef VXL_SHARED_PATHS_H
#define VXL_SHARED_PATHS_H

#ifdef __cplusplus
#include <kernels/shared/scene.h>
namespace voxelume {
#else
#include "shared/scene.h"
#endif

// The pixels and samples of a batch of sight rays, which come in tiles of 4 x 4 pixels as in
// sight.cl, and the maximum length of their paths.
typedef struct PathSampling {
    unsigned int first_tile;               // the first tile of the batch
    unsigned int tiles_x;                  // tiles per row of the image
    unsigned int samples;                  // per pixel
    unsigned int bounces;                  // the maximum number of times that a path is scattered
    unsigned int first_column, first_row;  // of the image in its frame, as in Camera
    unsigned int first_sample;             // number of the first sample in the samples' sequence
} PathSampling;
VXL_SIZE_IS(PathSampling, 28);

// The area of a light around LightRecord::position, in voxels: its points are
// position + a * axis_x + b * axis_y.
typedef struct LightAreaRecord {
    float4 axis_x;  // w: 1 for a disk, where a^2 + b^2 <= 1; 0 for a rectangle, |a|, |b| <= 1
    float4 axis_y;  // w: the area in square metres, 0 for the sun, which rays cannot run into
} LightAreaRecord;
VXL_SIZE_IS(LightAreaRecord, 32);

#ifdef __cplusplus
}  // namespace voxelume
#endif

// In global light, VXL_PATH_WEIGHT holds this state of the path:
//   bits 0..15   surfaces that the path has met, also those that it went straight through
//   bits 16..23  times that it was scattered
//   bit 24       the last time was a diffuse one
//   bit 25       the ray looks for an emitter: it ends there, and what else it meets doesn't count
//   bit 26       the medium scatters the path before the surface that the ray has met
#define VXL_PATH_STATE VXL_PATH_WEIGHT
#define VXL_STATE_MET 0xFFFFu
#define VXL_STATE_BOUNCE_SHIFT 16
#define VXL_STATE_BOUNCES 0xFFu
#define VXL_STATE_DIFFUSE 0x1000000u
#define VXL_STATE_TO_EMITTER 0x2000000u
#define VXL_STATE_IN_MEDIUM 0x4000000u
// VXL_PATH_EMITTER, behind the set of media in the arrays of paths, where paths send rays to
// emitters or to the sky:
//   of rays that look for an emitter, its number, or VXL_EMITTER_IS_SKY
//   of other rays, float: the probability of their direction, per solid angle; 0 if no ray to an
//   emitter could have had it, as behind mirrors
// VXL_PATH_DENSITY: float: the same for lights with an area, but as if physically based surfaces
// scattered all light; 0 for rays that no ray to a light could be.
// VXL_PATH_TRAVELLED: float, as the ray's t: how far before its origin the path was scattered last.
// Rays that go straight on restart behind surfaces of instances.

// The decisions at a surface that a path meets, or where the medium scatters it, each with a point
// of the unit square.
#define VXL_DECISION_LOBE 0u                // how the path goes on, and whether roulette ends it
#define VXL_DECISION_DIRECTION 1u           // of scattered light
#define VXL_DECISION_SIGHT 0xFFF3u          // where in the pixel a sight ray leads
#define VXL_DECISION_NEAR_AREA 0xFFF4u      // as NEAR_CHOICE, of many lights with an area
#define VXL_DECISION_AREA_CHOICE 0xFFF5u    // as CHOICE, of many lights with an area
#define VXL_DECISION_AREA_POINT 0xFFF6u     // where on that light
#define VXL_DECISION_NEAR_CHOICE 0xFFF7u    // which of many lights shines on a ray's way from near
#define VXL_DECISION_CHOICE 0xFFF8u         // which of many lights a shadow ray is sent to
#define VXL_DECISION_NEAR 0xFFF9u           // where on a ray's way a light shines from near by
#define VXL_DECISION_FLIGHT 0xFFFAu         // how far light travels in a scattering medium
#define VXL_DECISION_SKY 0xFFFBu            // whether a ray is sent to the sky or to an emitter
#define VXL_DECISION_LAYER 0xFFFCu          // whether the facets of a surface or its rest scatter
#define VXL_DECISION_LENS 0xFFFDu           // where on the lens a sight ray starts
#define VXL_DECISION_EMITTER 0xFFFEu        // which emitter a ray is sent to
#define VXL_DECISION_EMITTER_POINT 0xFFFFu  // where on that emitter
#define VXL_DECISION_LIGHT 2u               // from here on, one for each light: where on it

// The number of scatterings after which roulette may end a path.
#define VXL_ROULETTE_BOUNCES 3u

#endif
