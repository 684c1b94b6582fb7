// SPDX-License-Identifier: Apache-2.0
// How wide beams may be; see lib/traverse/beam.h. Read by kernels and host code.
#ifndef VXL_SHARED_BEAM_H
#define VXL_SHARED_BEAM_H

// The radius of a beam, in voxels of its dilated occupancy. Tests set other values, to check that
// beams that are too wide are detected.
#ifndef VXL_BEAM_RADIUS
#define VXL_BEAM_RADIUS 3.75f
#endif

#endif
