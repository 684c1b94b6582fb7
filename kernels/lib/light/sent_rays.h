// SPDX-License-Identifier: Apache-2.0
// The rays that paths send to emitters and to the sky, and their queue.
#ifndef VXL_SENT_RAYS_H
#define VXL_SENT_RAYS_H

#include "lib/lanes/fixed_point.h"
#include "lib/light/light_rays.h"
#include "lib/light/paths.h"
#include "lib/traverse/ray_queue.h"

/// The t at which rays have travelled a length in metres.
static inline lane_float t_after(lane_float metres, Vector direction, float4 edge) {
    const lane_float per_t = metres_per_t(edge, direction);
    return exact_divide(metres, LANES_SELECT(LANE_MASK(per_t > 0.0f), per_t, (lane_float)1.0f));
}

/// The emitters and the sky that paths look for, and the queue for rays to them: the parameters
/// that `bind` of SoughtLight sets, in its order.
#define VXL_SOUGHT_LIGHT_PARAMETERS                                                    \
    VXL_EMITTER_PARAMETERS VXL_SOUGHT_SKY_PARAMETERS global float *restrict sent_rays, \
        global uint *restrict sent_paths, global float *restrict sent_starts,          \
        global uint *restrict sent_inside, uint sent_stride

/// The queue for rays to emitters. `bind` of a RayQueue sets it like VXL_QUEUE_PARAMETERS.
#define VXL_SENT_QUEUE \
    { sent_rays, sent_paths, sent_starts, sent_inside, sent_stride }

/// The number of surfaces met, as it is in the states of rays that continue from one more.
static inline lane_uint met_after(lane_uint state) {
    return min((state & VXL_STATE_MET) + 1u, (lane_uint)VXL_STATE_MET);
}

/// Puts rays to emitters into their queue. They scatter no further.
static inline void send_to_emitters(const RayQueue* sent, lane_int wanted, lane_uint target,
                                    lane_uint state, uint bounces, NewRays* r,
                                    global uint* counters) {
    r->target = target;
    r->state = met_after(state) | (bounces << VXL_STATE_BOUNCE_SHIFT) | VXL_STATE_DIFFUSE |
               VXL_STATE_TO_EMITTER;
    const Slots slots = reserve_slots(wanted, counters + VXL_COUNT_TO_EMITTERS);
    put_rays(sent, r, &slots);
}

#endif
