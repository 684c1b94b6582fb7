// SPDX-License-Identifier: Apache-2.0
// The points of the unit square by which paths decide. They depend on the pixel of the frame, the
// sample and the decision alone, so no order of rays, tiles or batches changes an image.
#ifndef VXL_PATH_SAMPLES_H
#define VXL_PATH_SAMPLES_H

#include "lib/sampling/pixel_points.h"
#include "lib/traverse/ray_batch.h"
#include "shared/paths.h"
#include "shared/trace.h"

/// The pixels and samples of a packet's paths, and the number of surfaces that these have met.
typedef struct {
    SampledPixels of;
    lane_uint met;
} PathSamples;

/// The samples of paths in these states. `target` is the number of each path's sight ray in its
/// batch.
static inline PathSamples path_samples(const PathSampling* of, lane_uint target, lane_uint state) {
    const uint tiles_x = of->tiles_x;
    const lane_uint group = target / 16u;
    const lane_uint tile = group / of->samples + of->first_tile;
    const lane_uint row = tile / tiles_x;
    const lane_uint x = (tile - row * tiles_x) * 4u + (target & 3u) + of->first_column;
    const lane_uint y = row * 4u + ((target >> 2) & 3u) + of->first_row;
    const PathSamples s = {sampled_pixels(x | (y << 16), of->first_sample + group % of->samples),
                           state & VXL_STATE_MET};
    return s;
}

/// The samples of the paths in a packet of entries, which begins with `first`.
static inline PathSamples samples_of_paths(const PathSampling* of, const RayBatch* batch,
                                           uint first) {
    return path_samples(of, LANES_LOAD(batch->paths, VXL_PATH_TARGET * batch->stride + first),
                        LANES_LOAD(batch->paths, VXL_PATH_STATE * batch->stride + first));
}

/// The paths' points for a decision, one of VXL_DECISION_*.
static inline SquarePoint path_point(const PathSamples* s, uint decision) {
    return pixel_point(&s->of, (s->met << 16) | decision);
}

/// The paths' points for a decision, as 32-bit fractions.
static inline SquareBits path_bits(const PathSamples* s, uint decision) {
    return pixel_bits(&s->of, (s->met << 16) | decision);
}

#endif
