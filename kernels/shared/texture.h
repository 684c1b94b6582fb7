// SPDX-License-Identifier: Apache-2.0
// Textures of meshes as voxelizing reads them, for kernels and host alike.
#ifndef VXL_SHARED_TEXTURE_H
#define VXL_SHARED_TEXTURE_H

// The texture of a triangle: its number, and above it the level whose texels are as large as
// voxels.
#define VXL_NO_TEXTURE 0xFFFFFFFFu
#define VXL_TEXTURE_MASK 0xFFFFFFu
#define VXL_TEXTURE_LEVEL_SHIFT 24

// A texture's record: the number of its first texel, width, height, and how it goes on beyond its
// edges, along v four bits higher than along u.
#define VXL_TEXTURE_WRAP_REPEAT 0u
#define VXL_TEXTURE_WRAP_MIRROR 1u
#define VXL_TEXTURE_WRAP_CLAMP 2u
#define VXL_TEXTURE_WRAP_V_SHIFT 4

#endif
