// SPDX-License-Identifier: Apache-2.0
// lattice of a display -> the amount of the medium of S in each of its voxels, in the layout
// `lattice`.
//
// The mean over a voxel is measured on lines along the lattice's z, each of which is integrated
// exactly from voxel to voxel of the world.
#include "lib/display/lattice_mask.h"
#include "lib/display/probe.h"
#include "lib/lanes/fixed_point.h"
#include "lib/lanes/work_item.h"
#include "lib/traverse/segment.h"
#include "shared/display.h"
#include "shared/scene.h"

/// Sums over the lines of each lane's voxel: density times t, and density times t times colour.
typedef struct {
    lane_float amount;
    lane_float colored[3];
} MediumSums;

/// The part in the world of a lattice voxel's line from `from` to `from + along`, both in voxels of
/// the world. `*t_whole` becomes the length of the whole line in units of the segment's t.
static inline Segment line_in_world(PyramidShape shape, Vector from, Vector along,
                                    lane_float* t_whole) {
    const lane_float scale = power_of_two_scale(along.x, along.y, along.z);
    const Vector d = {snap_direction(along.x * scale), snap_direction(along.y * scale),
                      snap_direction(along.z * scale)};
    *t_whole = exact_reciprocal(scale);
    lane_float t_first = (lane_float)0.0f, t_last = *t_whole;
    clip_to_world(from, d, shape.size_x, shape.size_y, shape.size_z, &t_first, &t_last);
    const lane_int is_in = LANE_MASK(t_first < t_last);
    t_first = LANES_SELECT(is_in, t_first, (lane_float)0.0f);
    const lane_float zero = (lane_float)0.0f;
    const float fixed = shape.fixed_point;
    Segment line;
    line.origin.x =
        snap_position(clamp(fma(d.x, t_first, from.x), 0.0f, (float)shape.size_x), zero, fixed);
    line.origin.y =
        snap_position(clamp(fma(d.y, t_first, from.y), 0.0f, (float)shape.size_y), zero, fixed);
    line.origin.z =
        snap_position(clamp(fma(d.z, t_first, from.z), 0.0f, (float)shape.size_z), zero, fixed);
    line.direction = d;
    line.t_first = zero;
    line.t_last = LANES_SELECT(is_in, t_last - t_first, zero);
    return line;
}

/// Adds the medium along the `active` lanes' lines, weighted by `share`.
static inline void add_line(PyramidShape shape, const DensityView* density,
                            global const float* restrict colors, const Segment* line,
                            lane_float share, lane_int active, MediumSums* sums) {
    if (!VXL_MEDIUM_GRID) {
        sums->amount = fma(line->t_last, share, sums->amount);
        return;
    }
    const PyramidView p = grid_view(shape);
    Walk walk = walk_along(line);
    lane_float entered = line->t_first, entered_low = (lane_float)0.0f;
    lane_int walking = active & in_grid(&p, &walk) & LANE_MASK(line->t_first < line->t_last);
    while (lanes_any(walking)) {
        const DensityCell cell = look_up_density(density, walk.x, walk.y, walk.z, walking);
        const Stretch stretch = cross_cell(&p, density, &walk, &cell, line->t_first, line->t_last,
                                           &entered, &entered_low, walking);
        const lane_float amount =
            LANES_SELECT(stretch.counts, cell.density * stretch.length * share, (lane_float)0.0f);
        sums->amount += amount;
        for (uint c = 0; VXL_MEDIUM_COLORS && c < 3; ++c)
            sums->colored[c] =
                fma(amount, LANES_GATHER_FLOAT(colors, cell.index * 3u + c), sums->colored[c]);
        walking &= ~stretch.ends & in_grid(&p, &walk);
    }
}

/// Writes the mean density of the voxels in rows first_row .. first_row+rows-1 of the lattice. Rows
/// lie along x and follow one another along y, then z; voxel x of row i of these is at i * stride +
/// x. With VXL_MEDIUM_COLORS, three planes of `rows * stride` values follow: the mean density times
/// colour. Voxels outside the display are 0. Each voxel is measured on `lines_x` times `lines_y`
/// lines.
kernel void measure_medium(DisplayLattice lattice, PyramidShape shape, VXL_DENSITY_PARAMETERS,
                           global const float* restrict density_colors, uint lines_x, uint lines_y,
                           uint first_row, uint rows, uint stride, global float* restrict means) {
    const uint first = work_item() * VXL_LANES;
    if (first >= rows * stride) return;
    const DensityView density = VXL_DENSITY;
    const uint row = first_row + first / stride;
    const int x = (int)(first % stride), y = (int)(row % (uint)lattice.size_y),
              z = (int)(row / (uint)lattice.size_y);
    const lane_float share = (lane_float)(exact_quotient(1.0f, (float)(lines_x * lines_y)));
    const Vector along = {(lane_float)lattice.axis_z.x, (lane_float)lattice.axis_z.y,
                          (lane_float)lattice.axis_z.z};
    MediumSums sums;
    sums.amount = sums.colored[0] = sums.colored[1] = sums.colored[2] = (lane_float)0.0f;
    const lane_int active = LANE_MASK(LANES_NUMBERS + x < lattice.size_x);
    lane_float t_whole = (lane_float)1.0f;
    for (uint j = 0; j < lines_y; ++j)
        for (uint i = 0; i < lines_x; ++i) {
            const Vector at = {
                LANES_FLOAT(LANES_NUMBERS + x) + exact_quotient((float)i + 0.5f, (float)lines_x),
                (lane_float)((float)y + exact_quotient((float)j + 0.5f, (float)lines_y)),
                (lane_float)(float)z};
            const Segment line =
                line_in_world(shape, point_in_world(&lattice, at), along, &t_whole);
            add_line(shape, &density, density_colors, &line, share, active, &sums);
        }
    float values[4 * VXL_LANES];
    LANES_STORE(exact_divide(sums.amount, t_whole), values, 0);
    for (uint c = 0; c < 3; ++c)
        LANES_STORE(exact_divide(sums.colored[c], t_whole), values, (c + 1u) * VXL_LANES);
    const size_t plane = (size_t)rows * stride;
    for (int i = 0; i < VXL_LANES; ++i) {
        const bool shown = is_in_display(&lattice, (int4)(x + i, y, z, 0));
        for (uint c = 0; c < (VXL_MEDIUM_COLORS ? 4u : 1u); ++c)
            means[c * plane + first + (uint)i] = shown ? values[c * VXL_LANES + i] : 0.0f;
    }
}
