// SPDX-License-Identifier: Apache-2.0
// a light -> beams: how far from the light the world is empty.
#include "lib/lanes/work_item.h"
#include "lib/traverse/beam.h"
#include "shared/light_beams.h"

/// Sends the beams of `count` tiles of the grid, and writes their ends to the tiles' slots in
/// `ends`. An end is a coordinate on the grid's axis, or on minus that axis if its sign is
/// negative: everything that the beam's rays meet lies there or beyond. It is +infinity if the rays
/// meet nothing. `shape`, `sectors` and `bricks` are the dilated occupancy's.
kernel void send_light_beams(PyramidShape shape, global const uint* restrict sectors,
                             global const uint* restrict bricks, BeamGrid grid,
                             global const uint* restrict tiles, uint count,
                             global float* restrict ends) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count * VXL_BEAM_TILE) return;
    const PyramidView dilated_occupancy = pyramid_view(shape, sectors, bricks, 0, 0);
    const uint tile = tiles[first / VXL_BEAM_TILE], tiles_across = grid.columns / 4;
    const lane_int beam = LANES_NUMBERS + (int)(first % VXL_BEAM_TILE);
    const lane_int column = (int)(tile % tiles_across * 4) + (beam & 3);
    const lane_int row = (int)(tile / tiles_across * 4) + (beam >> 2);
    const lane_float at_b = grid.low_b + (LANES_FLOAT(column) + 0.5f) * grid.edge;
    const lane_float at_c = grid.low_c + (LANES_FLOAT(row) + 0.5f) * grid.edge;

    const int size = grid.axis == 0 ? shape.size_x : grid.axis == 1 ? shape.size_y : shape.size_z;
    const float s_near = grid.sign > 0.0f ? 0.0f : -(float)size;
    const float s_far = s_near + (float)size;
    // The far side is used as it is: a coarse dilated occupancy's grid may end beyond it.
    const float s_grid = grid.sign * grid.scale * grid.far_side;
    BeamAxis b, c;
    b.m = grid.sign * (grid.slope_b - at_b * grid.converging);
    c.m = grid.sign * (grid.slope_c - at_c * grid.converging);
    b.b0 = grid.scale * at_b - b.m * s_grid;
    c.b0 = grid.scale * at_c - c.m * s_grid;
    b.r0 = c.r0 = b.e = c.e = (lane_float)0.0f;  // the cross-sections are as wide as beams may be
    const lane_float s = run_beams(&dilated_occupancy, (lane_int)grid.axis, (lane_float)grid.sign,
                                   &b, &c, (lane_float)s_near, (lane_float)s_far, (lane_int)-1);
    const lane_float end = (s - 2.0f * VXL_BEAM_STEP) * inverse_of_power(grid.scale);
    LANES_STORE(LANES_SELECT(LANE_MASK(s >= s_far), (lane_float)INFINITY, end), ends,
                tile * VXL_BEAM_TILE + first % VXL_BEAM_TILE);
}
