// SPDX-License-Identifier: Apache-2.0
// light of rays, path by path -> the mean of all paths.
#include "lib/lanes/exact_float.h"
#include "lib/lanes/work_item.h"

/// Adds the light of rays 0 .. count-1 to their sums, which path 0 starts. After the last of
/// `paths`, stores the mean as the rays' light.
kernel void add_paths(uint count, uint stride, uint path, uint paths, global float* restrict sums,
                      global float* restrict radiance) {
    const uint n = work_item();
    if (n >= count) return;
    for (uint channel = 0; channel < 3; ++channel) {
        const size_t at = (size_t)channel * stride + n;
        const float light = radiance[at];
        const float sum = path == 0u ? light : sums[at] + light;
        sums[at] = sum;
        if (path + 1u == paths) radiance[at] = exact_quotient(sum, (float)paths);
    }
}
