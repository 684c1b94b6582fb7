// SPDX-License-Identifier: Apache-2.0
// Kernels that evaluate physically based surfaces, and scatter paths on them.
#pragma once

namespace voxelume {

inline constexpr const char* kSurfaceSource = R"(
#include "lib/lanes/work_item.h"
#include "lib/light/physical.h"
#include "lib/sampling/sobol.h"
static Vector askew_normal(void) {
    const Vector n = {(lane_float)0.36f, (lane_float)0.48f, (lane_float)-0.8f};
    return n;
}
static PhysicalView view_at(global const float* materials, lane_float cosine) {
    const Vector n = askew_normal();
    const Frame f = frame_around(n);
    const Vector out = {exact_sqrt(1.0f - cosine * cosine), (lane_float)0.0f, cosine};
    const Colors none = {0, 0, 0, (lane_uint)0};
    return view_physical(materials, (lane_int)-1, (lane_uint)0, (lane_uint)0, none, n,
                         out_of_frame(&f, out), (lane_int)0);
}
kernel void value_surface(global const float* materials, uint count, global const float* outs,
                          global const float* ins, uint stride, global float* values) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const PhysicalView s = view_at(materials, LANES_LOAD(outs, first));
    const Vector in = load_vector(ins, stride, first);
    lane_float value[3], density;
    physical_value(&s, out_of_frame(&s.frame, in), value, &density);
    for (uint c = 0; c < 3; ++c) LANES_STORE(value[c], values, c * stride + first);
    LANES_STORE(density, values, 3u * stride + first);
    for (uint c = 0; c < 3; ++c) LANES_STORE(s.albedo[c], values, (4u + c) * stride + first);
}
kernel void scatter_surface(global const float* materials, uint count, float out, uint seed,
                            uint stride, global float* ways) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const lane_uint number = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    const PhysicalView s = view_at(materials, (lane_float)out);
    const lane_uint case_number = mixed_number((lane_uint)seed);
    const SquarePoint at = sobol_point(number, decision_seed(case_number, (lane_uint)0));
    const lane_float layer =
        sobol_point(number, decision_seed(case_number, (lane_uint)1)).x;
    lane_int down;
    const Vector way = physical_direction(&s, at, layer, &down);
    store_vector(into_frame(&s.frame, way), ways, stride, first);
    lane_float value[3], density;
    const lane_int above = physical_value(&s, way, value, &density);
    const lane_float safe = LANES_SELECT(above, density, (lane_float)1.0f);
    for (uint c = 0; c < 3; ++c)
        LANES_STORE(exact_divide(value[c], safe), ways, (3u + c) * stride + first);
}
)";

}  // namespace voxelume
