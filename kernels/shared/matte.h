// SPDX-License-Identifier: Apache-2.0
// How many of the objects in a pixel a matte names. Read by kernels and host code.
#ifndef VXL_SHARED_MATTE_H
#define VXL_SHARED_MATTE_H

// Those that cover most of the pixel, two in each of Cryptomatte's layers of channels.
#define VXL_MATTE_RANKS 6

// Those whose parts of a pixel are known while samples are added to others.
#define VXL_MATTE_HELD 24

#endif
