// SPDX-License-Identifier: Apache-2.0
// The number of a work-item in the launch, whatever its two-dimensional shape.
#ifndef VXL_WORK_ITEM_H
#define VXL_WORK_ITEM_H

#pragma OPENCL FP_CONTRACT OFF

static inline uint work_item(void) {
    return (uint)(get_global_id(1) * get_global_size(0) + get_global_id(0));
}

#endif
