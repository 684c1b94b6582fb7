// SPDX-License-Identifier: Apache-2.0
// Winding numbers of a mesh at the points of bricks, as voxelize_winding.cl counts them.
#ifndef VXL_WINDINGS_H
#define VXL_WINDINGS_H

#include "shared/voxel.h"

/// The parameters that `bind` of Windings sets, in its order.
#define VXL_WINDING_PARAMETERS                                                     \
    global const short* restrict winding, global const short* restrict row_starts, \
        global const short* restrict passing

/// runtime/stages/voxelize/voxelize_steps.hpp has the meaning of each.
typedef struct {
    global const short* winding;
    global const short* row_starts;
    global const short* passing;
} WindingNumbers;

/// The value of WindingNumbers in a kernel with these parameters.
#define VXL_WINDINGS \
    { winding, row_starts, passing }

/// The winding number of point x + 16 y + 256 z of a brick whose bin has number `number` among
/// those with triangles, VXL_BRICK_OUTSIDE if it has none.
static inline int winding_at(const WindingNumbers* w, uint brick, uint number, uint point) {
    if (number == VXL_BRICK_OUTSIDE) return w->passing[brick];
    return w->winding[4096u * number + point] + w->row_starts[256u * number + point / 16u];
}

#endif
