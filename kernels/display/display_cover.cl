// SPDX-License-Identifier: Apache-2.0
// lines along a lattice's axes -> the coverage of the surfaces that they cross in each voxel.
#include "lib/display/lattice_mask.h"
#include "lib/display/line_order.h"
#include "lib/lanes/work_item.h"
#include "shared/display.h"

static inline bool is_shown(const DisplayLattice* l, global const uint* mask, int4 v) {
    if (!is_in_display(l, v)) return false;
    const size_t index = index_of(l, v);
    return (mask[index >> 5] & (1u << (index & 31u))) != 0u;
}

/// The voxel that shows a line's surface: the one in which the line crosses it, or else a neighbour
/// on the line. A cube within a row of cubes, whose own voxel shows nothing, counts for the nearest
/// shown voxel before it. The result's x is -1 if there is none.
static inline int4 shown_at(const DisplayLattice* l, global const uint* mask, float3 point,
                            uint axis, uint sense) {
    const float3 cell = floor(point);
    const int4 ahead = (int4)(axis == 0u, axis == 1u, axis == 2u, 0);
    int4 v = (int4)((int)cell.x, (int)cell.y, (int)cell.z, 0);
    if (sense == VXL_CROSSES_CUBE) {
        while (is_in_display(l, v) && !is_shown(l, mask, v)) v -= ahead;
    } else if (!is_shown(l, mask, v)) {
        const float3 within = point - cell;
        const float along = axis == 0u ? within.x : axis == 1u ? within.y : within.z;
        v += along < 0.5f ? -ahead : ahead;
        if (!is_shown(l, mask, v)) v += along < 0.5f ? 2 * ahead : -2 * ahead;
    }
    if (!is_shown(l, mask, v)) v.x = -1;
    return v;
}

/// Lines' points, `total` apart, the number of each line's first, and what is crossed there: the
/// parameters that `bind` of LinePoints sets, in its order.
#define VXL_LINE_PARAMETERS                                                                   \
    global const uint *restrict line_starts, uint total, global const float *restrict points, \
        global const uint *restrict surfaces

/// The voxels that are shown: their mask, the numbers before its groups, and each one's object,
/// opacity and logarithm: the parameters that `bind` of CoveredVoxels sets, in its order.
#define VXL_COVERED_PARAMETERS                                                                   \
    global const uint *restrict mask, global const uint *restrict starts,                        \
        global const uint *restrict voxel_objects, global const float *restrict voxel_opacities, \
        global const uint *restrict voxel_logs

/// Adds lines 0 .. count-1, which run along `axis`, to the voxels in which they cross surfaces. The
/// points of line n begin at line_starts[n]. For each axis, a voxel sums up how much of the lines
/// its surfaces cover, in units of 1 / VXL_COVER_UNITS; and, for each sense in which they are
/// crossed, the logarithms of what they let through, in units of -1 / VXL_LOG_UNITS. Surfaces of
/// the voxel's own object let through what the voxel does (`voxel_logs`), others what their
/// materials do (`logs`). The logarithm of 0 is VXL_OPAQUE_LOG. No line lies on a side of a voxel.
kernel void cover_lines(DisplayLattice lattice, uint count, VXL_LINE_PARAMETERS, uint axis,
                        global const float* restrict opacities, global const uint* restrict logs,
                        VXL_COVERED_PARAMETERS, global uint* restrict sums) {
    const uint line = work_item();
    if (line >= count) return;
    float clear = 1.0f;
    for (uint n = line_starts[line]; n < line_starts[line + 1u]; ++n) {
        const float3 point = load_point(points, total, n);
        const uint sense = as_uint(points[axis * (size_t)total + n]) & VXL_CROSSES_SENSES;
        const int4 v = shown_at(&lattice, mask, point, axis, sense);
        float opacity = fmin(opacity_of_surface(opacities, surfaces[n]), 1.0f);
        if (v.x < 0) {
            clear -= clear * opacity;
            continue;
        }
        const size_t voxel = number_of(mask, starts, index_of(&lattice, v));
        uint log_clear = logs[(surfaces[n] >> VXL_MATERIAL_SHIFT) & VXL_MATERIAL_MASK];
        const bool is_own = voxel_objects[voxel] == (surfaces[n] & VXL_OBJECT_MASK) + 1u;
        if (is_own) opacity = voxel_opacities[voxel];
        if (is_own || log_clear == VXL_OPAQUE_LOG) log_clear = voxel_logs[voxel];
        const float behind = clear - clear * opacity;
        global uint* sum = sums + (voxel * 3u + axis) * VXL_COVER_SUMS;
        atomic_add(sum, (uint)fma(clear - behind, VXL_COVER_UNITS, 0.5f));
        if (log_clear != VXL_OPAQUE_LOG) atomic_add(sum + 1u + sense, log_clear);
        clear = behind;
    }
}
