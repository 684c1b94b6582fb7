// SPDX-License-Identifier: Apache-2.0
// Textures of meshes, as voxelizing and shading read them, for kernels and host alike.
#ifndef VXL_SHARED_TEXTURE_H
#define VXL_SHARED_TEXTURE_H

// The texture of a triangle: its number and, above that, the level whose texels are as large as
// voxels.
#define VXL_NO_TEXTURE 0xFFFFFFFFu
#define VXL_TEXTURE_MASK 0xFFFFFFu
#define VXL_TEXTURE_LEVEL_SHIFT 24

// A texture's record: the index of its first texel, width, height, and how the texture continues
// beyond its edges; the bits for v are four bits higher than those for u.
#define VXL_TEXTURE_WRAP_REPEAT 0u
#define VXL_TEXTURE_WRAP_MIRROR 1u
#define VXL_TEXTURE_WRAP_CLAMP 2u
#define VXL_TEXTURE_WRAP_V_SHIFT 4
#define VXL_TEXTURE_WRAP_MASK 15u

// What an exact triangle wears, in words:
//   VXL_WORN_UVS      u and v of each corner, floats in texture widths from the upper left
//   VXL_WORN_TEXTURE  where its texture begins among the textures; VXL_NO_TEXTURE: it wears none
//   VXL_WORN_COLORS   the colours of its corners, 0x00BBGGRR in sRGB, which multiply the texture
#define VXL_WORN_UVS 0
#define VXL_WORN_TEXTURE 6
#define VXL_WORN_COLORS 7
#define VXL_WORN_WORDS 10

// The textures of exact triangles are one array of words. The first 256 are floats: the linear
// light of each sRGB code. A texture begins with its width, height, how it continues beyond its
// edges, as in its record above, and what its alpha means; its texels follow, level after level.
//   VXL_ALPHA_OPAQUE  nothing: the texture covers all
//   up to 255         a texture of an alpha below this code, in 1/255, isn't there
//   VXL_ALPHA_BLEND   alpha is opacity
#define VXL_TEXTURE_CURVE 256
#define VXL_TEXTURE_HEAD 4
#define VXL_ALPHA_OPAQUE 0u
#define VXL_ALPHA_BLEND 256u

// The maps of a texture lie on the same triangles and multiply values of the material other than
// its colour. They are textures, too. A texture with VXL_TEXTURE_HAS_MAPS in its bits about edges
// has a record of VXL_MAP_WORDS in front of it for each map:
//   VXL_MAP_OFFSET     how far behind the texture the map begins, in words, modulo 2^32; 0: none
//   VXL_MAP_TRANSFORM  six floats a..f: (u, v) of the texture is (a u + b v + c, d u + e v + f)
//                      of it
// Channels are those of glTF: green multiplies roughness, blue multiplies metalness, both
// unconverted; emission is a colour in sRGB.
#define VXL_TEXTURE_HAS_MAPS 0x100u
#define VXL_MAP_GLOSS 0u
#define VXL_MAP_EMISSION 1u
#define VXL_MAP_COUNT 2
#define VXL_MAP_OFFSET 0
#define VXL_MAP_TRANSFORM 1
#define VXL_MAP_WORDS 7

// What rays see of the textures at each hit: its colour, its opacity, and how wide the ray was
// there, all floats, hit by hit. The first three multiply the material's colour, the fourth its
// opacity. Where textures have maps, values of the material at the hit follow: in global light the
// first two below, for physically based ones; in local light the last six.
#define VXL_PAINT_OPACITY 3
#define VXL_PAINT_WIDTH 4
#define VXL_PAINT_ROUGHNESS 5
#define VXL_PAINT_METALLIC 6
#define VXL_PAINT_DIFFUSE 5
#define VXL_PAINT_SPECULAR 6
#define VXL_PAINT_SHININESS 7
#define VXL_PAINT_REFLECTION 8
#define VXL_PAINT_HIGHLIGHT_TINT 9
#define VXL_PAINT_MIRROR_TINT 10
#define VXL_PAINT_FLOATS(maps) ((maps) ? 11 : 5)

#endif
