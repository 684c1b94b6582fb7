// SPDX-License-Identifier: Apache-2.0
// The amount of medium along a ray: the sum of density times length over its voxels.
//
// A length is the difference of two crossing times, each held in two floats, so that a thin layer
// far along the ray is measured as exactly as a thick one near its start.
#ifndef VXL_DENSITY_H
#define VXL_DENSITY_H

#include "lib/traverse/walk.h"
#include "shared/medium.h"

typedef struct {
    DensityShape shape;
    global const uint* restrict bricks;
    global const float* restrict values;
} DensityView;

/// The parameters that `bind` of a DensityGrid sets, in its order.
#define VXL_DENSITY_PARAMETERS                                              \
    DensityShape density_shape, global const uint *restrict density_bricks, \
        global const float *restrict density_values

/// The value of a DensityView in a kernel with these parameters.
#define VXL_DENSITY \
    { density_shape, density_bricks, density_values }

/// The lattice's data for a voxel.
typedef struct {
    lane_float density;
    lane_int log2_size;  // of the aligned cube of cells around it that has one density
    lane_uint index;     // index of the density among the values
} DensityCell;

/// The density at voxel (x,y,z); lanes that are not `active` read something harmless.
static inline DensityCell look_up_density(const DensityView* d, lane_int x, lane_int y, lane_int z,
                                          lane_int active) {
    const lane_int cx = x >> d->shape.shift_x, cy = y >> d->shape.shift_y,
                   cz = z >> d->shape.shift_z;
    const lane_int brick =
        (((cz >> 4) * d->shape.bricks_y + (cy >> 4)) * d->shape.bricks_x + (cx >> 4)) & active;
    const lane_uint word = LANES_GATHER_UINT(d->bricks, brick);
    const lane_int alike = LANE_MASK(LANES_AS_INT(word) < 0);
    const lane_uint cell = LANES_AS_UINT((cx & 15) | ((cy & 15) << 4) | ((cz & 15) << 8));
    const lane_uint index = LANES_SELECT(alike, word & VXL_DENSITY_SLOT, (word << 12) | cell);
    DensityCell result;
    result.density = LANES_GATHER_FLOAT(d->values, index);
    result.index = index;
    result.log2_size = LANES_AS_INT((word >> VXL_DENSITY_SIZE_SHIFT) & 31u) & alike;
    return result;
}

/// The plane across which a block of 1 << log2_size voxels, cut by the world's side, is left.
static inline lane_int exit_plane(lane_int cell, lane_int positive, lane_int log2_size, int size) {
    const lane_int edge = (lane_int)1 << log2_size;
    return min((cell & -edge) + (positive & edge), (lane_int)size);
}

static inline void leave_cells(const PyramidView* p, const DensityView* d, Walk* w,
                               lane_int log2_size, lane_int moving) {
    cross_first(p, w, exit_plane(w->x, w->px, log2_size + d->shape.shift_x, p->size_x),
                exit_plane(w->y, w->py, log2_size + d->shape.shift_y, p->size_y),
                exit_plane(w->z, w->pz, log2_size + d->shape.shift_z, p->size_z), moving);
}

/// The exact time at which the walk entered its cell, minus the float that represents it.
static inline lane_float time_remainder(const Walk* w) {
    const lane_int x = LANE_MASK(w->axis == 0), y = LANE_MASK(w->axis == 1);
    const lane_float nx = LANES_FLOAT(w->x - ~w->px) - w->ox;
    const lane_float ny = LANES_FLOAT(w->y - ~w->py) - w->oy;
    const lane_float nz = LANES_FLOAT(w->z - ~w->pz) - w->oz;
    const lane_float n = LANES_SELECT(x, nx, LANES_SELECT(y, ny, nz));
    const lane_float d = LANES_SELECT(x, w->dx, LANES_SELECT(y, w->dy, w->dz));
    const lane_float inverse = LANES_SELECT(x, w->ix, LANES_SELECT(y, w->iy, w->iz));
    return fma(-w->t, d, n) * inverse;
}

/// Adds `term` to the `adding` lanes of a sum; `lost` holds what rounding has removed from it
/// (Kahan 1965).
static inline void add_exactly(lane_float* sum, lane_float* lost, lane_float term,
                               lane_int adding) {
    const lane_float corrected = term - *lost;
    const lane_float next = *sum + corrected;
    *lost = LANES_SELECT(adding, (next - *sum) - corrected, *lost);
    *sum = LANES_SELECT(adding, next, *sum);
}

/// The part of a ray inside one voxel of each lane.
typedef struct {
    lane_float length;  // t, >= 0
    lane_int counts;    // mask: some of it lies behind t_first
    lane_int ends;      // mask: it is the last part
} Stretch;

/// Leaves the voxels around the walk's own that have one density. On entry, `entered` plus
/// `entered_low` is where the stretch begins; on return, where the next one begins.
static inline Stretch cross_cell(const PyramidView* p, const DensityView* d, Walk* w,
                                 const DensityCell* cell, lane_float t_first, lane_float t_last,
                                 lane_float* entered, lane_float* entered_low, lane_int walking) {
    leave_cells(p, d, w, cell->log2_size, walking);
    Stretch stretch;
    stretch.counts = walking & LANE_MASK(w->t > t_first);
    stretch.ends = LANE_MASK(w->t >= t_last);
    const lane_float left = LANES_SELECT(stretch.ends, t_last, w->t);
    const lane_float left_low = LANES_SELECT(stretch.ends, (lane_float)0.0f, time_remainder(w));
    stretch.length = fmax((left - *entered) + (left_low - *entered_low), 0.0f);
    *entered = LANES_SELECT(stretch.counts, left, *entered);
    *entered_low = LANES_SELECT(stretch.counts, left_low, *entered_low);
    return stretch;
}

/// The sum of density times t over the voxels between t_first and t_last >= t_first of the `active`
/// walks, which begin at their rays' origins.
static inline lane_float walk_density(const PyramidView* p, const DensityView* d, Walk* w,
                                      lane_float t_first, lane_float t_last, lane_int active) {
    lane_float sum = (lane_float)0.0f, lost = (lane_float)0.0f;
    lane_float entered = t_first, entered_low = (lane_float)0.0f;
    lane_int walking = active & in_grid(p, w) & LANE_MASK(t_first < t_last);
    while (lanes_any(walking)) {
        const DensityCell cell = look_up_density(d, w->x, w->y, w->z, walking);
        const Stretch stretch =
            cross_cell(p, d, w, &cell, t_first, t_last, &entered, &entered_low, walking);
        add_exactly(&sum, &lost, cell.density * stretch.length, stretch.counts);
        walking &= ~stretch.ends & in_grid(p, w);
    }
    return sum - lost;
}

#endif
