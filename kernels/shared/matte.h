// SPDX-License-Identifier: Apache-2.0
// The number of objects in a pixel that a matte names. Read by kernels and host code.
#ifndef VXL_SHARED_MATTE_H
#define VXL_SHARED_MATTE_H

// The number of objects that a finished pixel names: those that cover most of it, two in each of
// Cryptomatte's layers of channels.
#define VXL_MATTE_RANKS 6

// The number of objects in a pixel whose weights are kept while samples are added.
#define VXL_MATTE_HELD 24

#endif
