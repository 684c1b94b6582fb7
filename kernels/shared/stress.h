// SPDX-License-Identifier: Apache-2.0
// The numbers with which `voxelume stress` hashes the cells of a walk, on host and device.
#ifndef VXL_SHARED_STRESS_H
#define VXL_SHARED_STRESS_H

#define VXL_HASH_X 0x8DA6B343u
#define VXL_HASH_Y 0xD8163841u
#define VXL_HASH_Z 0xCB1AB31Fu
#define VXL_HASH_FACTOR 0x9E3779B1u

#endif
