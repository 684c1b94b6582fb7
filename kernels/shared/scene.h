// SPDX-License-Identifier: Apache-2.0
// The scene's records for kernels. Lengths are in the world's voxels unless noted otherwise;
// colours are linear.
#ifndef VXL_SHARED_SCENE_H
#define VXL_SHARED_SCENE_H

#ifdef __cplusplus
#include <cstdint>
namespace voxelume {
struct float4 {
    float x, y, z, w;
};
#define VXL_SIZE_IS(type, bytes) static_assert(sizeof(type) == bytes)
#else
#define VXL_SIZE_IS(type, bytes) typedef char VXL_SIZE_OF_##type[sizeof(type) == bytes ? 1 : -1]
#endif

// The pyramid's shape, and the numbers of its fixed-point arithmetic.
typedef struct PyramidShape {
    float4 edge;                 // xyz: a voxel's edges in metres; w unused
    float4 inverse_edge;         // 1 / edge
    int size_x, size_y, size_z;  // voxels
    int sectors_x, sectors_y;
    float plane_bound;    // voxels: how far a computed crossing can lie from the true one
    float fixed_point;    // 2^fraction_bits: one voxel in the rays' fixed point
    float origin_offset;  // in scenes with instances, voxels: how far along the normal rays are
                          // moved when they leave an instance's surface; larger than the rounding
                          // that may put their origin behind it
} PyramidShape;
VXL_SIZE_IS(PyramidShape, 64);

// Values of Camera::shape.
#define VXL_SHAPE_PYRAMID 0
#define VXL_SHAPE_SECTOR 1
#define VXL_SHAPE_BALL 2
#define VXL_SHAPE_BOX 3

// The steps of filter_positions in runtime/stages/trace/sight.hpp.
#define VXL_FILTER_STEPS 1024u

// E: where sight rays start, and the range of directions that they cover.
typedef struct Camera {
    float4 origin;      // E, or the point `lead` before it; w unused
    float4 origin_low;  // the part of the origin that rounding removed from `origin`
    float4 axis_x;      // X_E, Y_E, Z_E: voxels per metre along each
    float4 axis_y;
    float4 axis_z;
    float half_x;  // pyramid: tangent of the half angle; sector, ball: half angle, radians; box:
                   // metres
    float half_y;
    float near_plane;  // metres; along Z_E for pyramid and box, along the ray for sector and ball
    float far_plane;
    int width, height;  // pixels of the image
    int samples;        // per pixel
    int shape;
    float sample_weight;  // factor from the sum of the samples to the image: 1 / all of them, or 1
                          // where others follow
    float lead;  // metres along Z_E from the observer to `origin`, where a pyramid's rays are
                 // already spread out; near_plane and far_plane count from there
    int first_column, first_row;    // of the image in its frame, if it is a part of one
    int frame_width, frame_height;  // pixels that half_x and half_y span
    float lens_radius;              // metres; 0: all rays start at one point
    float lens_slope;               // lens_radius over the depth that is in focus
    int first_sample;               // number of the first sample in the samples' sequence
    int blades;                     // VXL_BLADES: corners of the lens, at least 3
    int earlier_samples;            // number of samples that the image already holds
    float earlier_weight;           // factor from what the image holds to the sum of its samples
    int is_last;                    // 1: no more samples follow
    int unused[3];
} Camera;
VXL_SIZE_IS(Camera, 176);

// Marks an empty slot in a list of pixels.
#define VXL_NO_PIXEL 0xFFFFFFFFu

typedef struct MaterialRecord {
    float color[3];
    float diffuse;
    float absorption[3];  // per metre
    float ior;
    float emission[3];
    float specular;
    float shininess;
    float reflection;
    float refraction;
    float opacity;
    float fresnel;           // 1: the Fresnel reflectance scales reflection and refraction
    float checker_color[3];  // colour of every other block ...
    float checker_scale[3];  // ... that is 1 / scale voxels wide; all 0: no blocks
    float checker_shift[3];  // block coordinate of the world's origin
    // For physically based materials, in global light:
    float metallic;
    float width;        // GGX's alpha of the highlights; 0: the material is not physically based
    float reflectance;  // reflectance at normal incidence of the part that isn't metal
    float albedos;      // the index of the first value of its table, see below
    float missing;      // AlbedoEntry::missing, its cosine-weighted mean over all directions
    float matt;         // factor of the diffuse part that makes up for light lost at the facets
} MaterialRecord;
VXL_SIZE_IS(MaterialRecord, 128);
#define VXL_MATERIAL_COLOR 0
#define VXL_MATERIAL_DIFFUSE 3
#define VXL_MATERIAL_ABSORPTION 4
#define VXL_MATERIAL_IOR 7
#define VXL_MATERIAL_EMISSION 8
#define VXL_MATERIAL_SPECULAR 11
#define VXL_MATERIAL_SHININESS 12
#define VXL_MATERIAL_REFLECTION 13
#define VXL_MATERIAL_REFRACTION 14
#define VXL_MATERIAL_OPACITY 15
#define VXL_MATERIAL_FRESNEL 16
#define VXL_MATERIAL_CHECKER_COLOR 17
#define VXL_MATERIAL_CHECKER_SCALE 20
#define VXL_MATERIAL_CHECKER_SHIFT 23
#define VXL_MATERIAL_METALLIC 26
#define VXL_MATERIAL_WIDTH 27
#define VXL_MATERIAL_REFLECTANCE 28
#define VXL_MATERIAL_ALBEDOS 29
#define VXL_MATERIAL_MISSING 30
#define VXL_MATERIAL_MATT 31
#define VXL_MATERIAL_FLOATS 32

// The light that a surface of GGX's microfacets returns, for VXL_ALBEDO_ENTRIES angles, in the
// array of materials behind the materials. With u from 0 to 1, entry u * (VXL_ALBEDO_ENTRIES - 1)
// holds
//   missing    for the cosine c with u^2 = c (1 + width) / (c + width), in which tables of all
//              widths are smooth: the share that facets don't return at once if they reflect all
//   by_angle   for the cosine u^2: which part of what they return at once then they return if they
//              reflect (1 - m)^5 of the light, m the cosine of the angle at which it meets them
#define VXL_ALBEDO_ENTRIES 64
#define VXL_ALBEDO_FLOATS 2
#define VXL_ALBEDO_MISSING 0
#define VXL_ALBEDO_BY_ANGLE 1

// Where textures have maps, a material that uses them (takes_gloss_map) has, in local light, the
// values of its physically based model: VXL_MATERIAL_METALLIC, its roughness in VXL_MATERIAL_WIDTH,
// above 0, and the factor of its highlights in VXL_MATERIAL_REFLECTANCE. In global light,
// VXL_MATERIAL_MAPPED is the index of the first value of the tables of all roughnesses, or 0:
// VXL_ROUGHNESS_STEPS evenly spaced roughnesses from 0 to 1. First come two means for each, of
// AlbedoMeans missing and by_angle, then their tables as above.
#define VXL_MATERIAL_MAPPED VXL_MATERIAL_FRESNEL
#define VXL_ROUGHNESS_STEPS 16

// In local light: the share of a material's highlight, and of its mirror image, that takes on the
// surface's colour, as with metals; the rest is colourless.
#define VXL_MATERIAL_HIGHLIGHT_TINT VXL_MATERIAL_ALBEDOS
#define VXL_MATERIAL_MIRROR_TINT VXL_MATERIAL_MISSING

// Physically based materials that let light through have VXL_MATERIAL_REFRACTION, the share of the
// surface that lets it through, and here the index of the first value of their block, or 0 for
// none:
#define VXL_MATERIAL_GLASS VXL_MATERIAL_SHININESS
// A block lies in the array of materials as well. Of two numbers side by side, the first is for the
// outside, the second for the inside:
//   VXL_GLASS_IOR          the index of refraction over that of the outside
//   VXL_GLASS_BACK         2: the part of light that facets don't return at once which comes back
//   VXL_GLASS_PER_MISSING  2: 1 over the mean share of that light, by the cosine
//   VXL_GLASS_TABLE        VXL_GLASS_ENTRIES times 2: the share of that light. The angles of
//   entries
//                          are evenly spaced in the mean of their cosine, as total reflection
//                          begins at a steep one, and of the u of VXL_ALBEDO_MISSING
#define VXL_GLASS_ENTRIES 128
#define VXL_GLASS_IOR 0
#define VXL_GLASS_BACK 1
#define VXL_GLASS_PER_MISSING 3
#define VXL_GLASS_TABLE 8
#define VXL_GLASS_FLOATS 288

// Physically based materials that have a coat, or that reflect less than their index of refraction
// says, have here the index of the first value of their block, or 0 for none:
#define VXL_MATERIAL_COAT VXL_MATERIAL_SPECULAR
// A block lies in the array of materials as well:
//   VXL_COAT_REFLECTS     what the reflectance of what isn't metal is multiplied by
//   VXL_COAT_SHARE        of the surface that the coat is on
//   VXL_COAT_WIDTH        of its highlights
//   VXL_COAT_ALBEDOS      the number of the first value of its table, VXL_ALBEDO_ENTRIES
//   VXL_COAT_LATER        what its facets return later of the light that they miss
//   VXL_COAT_PER_MISSING  1 over the mean of what they miss
//   VXL_COAT_PER_ENTERED  1 over the mean share of light that gets through it
//   VXL_COAT_TABLE        VXL_ALBEDO_ENTRIES times 2, by the root of the cosine: of light that
//                         facets below it return at once, white ones or those that reflect
//                         (1 - m)^5, how much more the coat takes on its way, as it leaves lower
#define VXL_COAT_REFLECTS 0
#define VXL_COAT_SHARE 1
#define VXL_COAT_WIDTH 2
#define VXL_COAT_ALBEDOS 3
#define VXL_COAT_LATER 4
#define VXL_COAT_PER_MISSING 5
#define VXL_COAT_PER_ENTERED 6
#define VXL_COAT_TABLE 8
#define VXL_COAT_FLOATS 160

// The reflectance of a coat at normal incidence; its index of refraction is 1.5.
#define VXL_COAT_REFLECTANCE 0.04f

// Values of LightRecord::kind.
#define VXL_LIGHT_POINT 0
#define VXL_LIGHT_SPOT 1
#define VXL_LIGHT_DIRECTIONAL 2
#define VXL_LIGHT_AREA_SAMPLE 3

typedef struct LightRecord {
    float4 position;     // point, spot, area light sample: where it is; directional: the direction
                         // towards it; w unused
    float4 direction;    // spot: unit vector in metric space along which the light travels; area
                         // light sample: its normal; w unused
    float4 intensity;    // rgb at 1 m, or everywhere for directional; area light sample: radiance
                         // times area over pi; w: on the host, not 0 for a light that is dark
    float inner_cosine;  // spot: full light inside this angle's cosine, none outside outer_cosine's
    float outer_cosine;
    int kind;
    float spread;  // area light sample: its area over pi, in square metres
} LightRecord;
VXL_SIZE_IS(LightRecord, 64);

// The environment: the medium of S and the light around it.
typedef struct Environment {
    float4 background;  // radiance
    float4 ambient;
    float4 absorption;  // of the medium, per metre
    float4 color;       // radiance that an infinitely deep medium shows
} Environment;
VXL_SIZE_IS(Environment, 64);

#ifdef __cplusplus
}  // namespace voxelume
#endif

#endif
