// radiance at surfaces -> radiance at the rays' starts: what the medium of S takes and adds.
#include "lib/exact_exp.h"
#include "lib/fixed_point.h"
#include "lib/work_item.h"
#include "shared/scene.h"
#include "shared/trace.h"

/// Gives each ray's radiance what the world's medium does to it between the ray's start and its
/// end.
kernel void absorb_sight(PyramidShape shape, Space space, global const float* restrict rays,
                         global const uint* restrict hits, uint count, uint stride,
                         global float* restrict radiance) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const lane_int hit =
        LANE_MASK(LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first) != VXL_NO_VOXEL);
    const lane_float t_hit = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first));
    // A ray that met nothing goes on to the far surface, or to the world's end.
    lane_float t_first = (lane_float)0.0f;
    lane_float t_last = LANES_LOAD(rays, VXL_RAY_END * stride + first);
    lane_float metres = (lane_float)0.0f;
    const float edges[3] = {shape.edge.x, shape.edge.y, shape.edge.z};
    const int sizes[3] = {shape.size_x, shape.size_y, shape.size_z};
    for (uint a = 0; a < 3; ++a) {
        const lane_float o = LANES_LOAD(rays, (VXL_RAY_OX + a) * stride + first);
        const lane_float d = LANES_LOAD(rays, (VXL_RAY_DX + a) * stride + first);
        clip_axis(o, d, (float)sizes[a], &t_first, &t_last);
        metres = fma(d * edges[a], d * edges[a], metres);
    }
    metres = exact_sqrt(metres);
    const lane_float path = fmax(LANES_SELECT(hit, t_hit, t_last), 0.0f) * metres;
    const float absorption[3] = {space.absorption.x, space.absorption.y, space.absorption.z};
    const float color[3] = {space.color.x, space.color.y, space.color.z};
    for (int channel = 0; channel < 3; ++channel) {
        const lane_float passed = exact_exp(-absorption[channel] * path);
        const uint place = (uint)channel * stride + first;
        const lane_float behind = LANES_LOAD(radiance, place);
        LANES_STORE(fma(passed, behind - color[channel], (lane_float)color[channel]), radiance,
                    place);
    }
}
