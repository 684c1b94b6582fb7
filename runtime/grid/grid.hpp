// SPDX-License-Identifier: Apache-2.0
// The two forms of a voxel grid on a device: the bricks that stages write, the pyramid that rays
// read.
//
//   voxelize, place ─► BrickGrid ─ index ─► Pyramid ─► trace
//
// Index rules, equal for both: x fastest, then y, then z. A brick is 16³ voxels, a leaf 4³, a
// sector 64³. Bit (x & 3) | (y & 3) << 2 | (z & 3) << 4 of a 64-bit mask stands for one of 4³
// children.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <vector>

#include "kernels/shared/instance.h"
#include "kernels/shared/source_mesh.h"
#include "runtime/grid/field_place.hpp"
#include "runtime/grid/grid_frame.hpp"
#include "runtime/opencl/buffer.hpp"
#include "runtime/scene/parts/surface.hpp"

namespace voxelume {

/// Values of BrickGrid::slots for a brick that is not stored.
inline constexpr uint32_t kBrickOutside = 0xFFFFFFFFu;  ///< empty space
inline constexpr uint32_t kBrickInside = 0xFFFFFFFEu;   ///< wholly inside a solid, without surface

/// Distances are stored in 1/8192 voxel (of the shortest edge), positive outside, saturated at
/// ±32767.
inline constexpr int kDistanceUnitsPerVoxel = 8192;

/// Set in an entry of `primitives` that names an analytic solid.
inline constexpr uint32_t kSolidPrimitive = 0x80000000u;

struct GridPart;

/// A sparse grid of 16³ bricks, as `voxelize` and `place` make it. Buffers that aren't needed are
/// empty.
struct BrickGrid {
    GridFrame frame;
    uint32_t brick_count = 0;      ///< stored bricks; their slots are 0 .. brick_count-1
    Buffer<uint32_t> slots;        ///< one per brick of frame.bricks(): its slot, or kBrick*
    Buffer<uint32_t> coordinates;  ///< one per slot: the brick's index into `slots`, ascending
    Buffer<uint64_t> occupancy;    ///< 64 per slot: masks of the leaves; cubes and exact voxels
    Buffer<int16_t> distance;      ///< 4096 per slot: at nodes (voxels' minimum corners), x fastest
    Buffer<uint32_t> attributes;   ///< 4096 per slot: packed attributes of each voxel, see
                                   ///< shared/voxel.h
    uint32_t attribute = 0;        ///< packed attributes of every voxel if `attributes` is empty
    Buffer<uint32_t> colors;       ///< 4096 per slot: the colour of each voxel, packed as in
                                   ///< shared/voxel.h
    Buffer<uint32_t> normals;      ///< 4096 per slot: the normals of the surface that cubes stand
                                   ///< for, see shared/normal.h; empty if no cube has one
    bool transparent = false;      ///< true if some voxel's colour isn't opaque
    bool cubes = true;             ///< false if `attributes` are known to make no voxel a cube

    // Exact surfaces: voxel v of slot s lists primitives[first[s*4096+v] .. first[s*4096+v+1]).
    Buffer<uint32_t> primitive_first;  ///< 4096 per slot + 1
    Buffer<uint32_t> primitives;       ///< triangles' numbers, or kSolidPrimitive | solid's number
    Buffer<float> triangles;           ///< 9 per triangle: its corners in this grid's voxels
    Buffer<uint32_t> triangle_attributes;  ///< packed attributes of each triangle, see
                                           ///< shared/voxel.h
    Buffer<uint32_t> triangle_normals;     ///< 3 per triangle, see shared/normal.h; empty if no
                                           ///< triangle has some
    Buffer<uint32_t> triangle_textures;    ///< VXL_WORN_WORDS per triangle, see shared/texture.h;
                                           ///< empty if no triangle wears a texture
    Buffer<uint32_t> textures;             ///< the textures of triangles
    uint64_t texture_key = 0;              ///< a hash of `textures`
    bool texture_alpha = false;            ///< true if the alpha of one of these textures counts
    bool texture_maps = false;             ///< true if one of these textures has maps
    Buffer<uint32_t> solids;               ///< analytic solids, see shared/solid.h

    FieldPlace place;             ///< place of this grid among the parts of a solid
    std::vector<GridPart> parts;  ///< the other parts of a solid of several; this grid is the first
};

/// A part of a solid, in the same frame as the solid's first.
struct GridPart {
    std::shared_ptr<const BrickGrid> grid;
    FieldPlace place;
};

/// A model that instances share, and its ranges of a pyramid's buffers.
struct InstanceModel {
    GridFrame frame;
    uint32_t first_sector = 0;  ///< start of its table in Pyramid::sectors
    uint32_t first_triangle = 0, triangle_count = 0;
    uint32_t first_solid = 0;    ///< record of Pyramid::solids
    glm::ivec3 low{0}, high{0};  ///< the box of its voxels; empty for a model without voxels
};

/// An object that shows a model but is not placed in the world's voxels.
struct Instance {
    uint32_t object = 0;                              ///< the object's number in the scene
    uint32_t model = 0;                               ///< index into InstanceSet::models
    uint32_t first_material = 0, material_count = 0;  ///< the materials of its groups, in
                                                      ///< InstanceSet::materials
};

/// The instances of a world, numbered as in `list`.
struct InstanceSet {
    std::vector<InstanceModel> models;
    std::vector<Instance> list;
    std::vector<size_t> counted;  ///< in counted worlds: Pyramid::records() of each model
    float origin_offset = 0;      ///< PyramidShape::origin_offset
    VoxelBox box;                 ///< around all instances at their present positions
    Buffer<InstanceRecord> records;
    Buffer<InstanceNode> nodes;  ///< the tree over the instances' boxes; the root is the first node
    Buffer<uint32_t> materials;

    bool empty() const { return list.empty(); }
};

/// The meshes of smooth objects with textures, for rays that meet these objects; empty if no object
/// has such a mesh.
struct SourceMeshes {
    Buffer<uint32_t> words;        ///< see shared/source_mesh.h
    Buffer<SourceRecord> objects;  ///< one for each of the scene's objects
    bool has_maps = false;         ///< true if one of their textures has maps
};

/// The sparse 64-ary occupancy pyramid that rays traverse without a stack.
///
/// `sectors` is dense; everything below is left-packed in ascending order, so empty space costs
/// nothing. A leaf's number is its brick's first leaf plus the count of mask bits below its own; a
/// voxel's number is its leaf's first voxel plus the count of mask bits below its own.
///
/// With instances, the pyramids of their models follow the world's in every buffer, with numbers
/// that count from the buffers' starts. The counts below include the models.
struct Pyramid {
    GridFrame frame;
    uint32_t leaf_count = 0;
    uint32_t voxel_count = 0;
    Buffer<uint32_t> sectors;  ///< n: its brick records are 64n .. 64n+63, in the order of mask
                               ///< bits; or 1<<31 | log2 of the edge of the empty cube around it: 6
                               ///< for its own 64³, 8 for its aligned 256³
    Buffer<uint32_t> bricks;   ///< 4 per record: mask low, mask high (of leaves), then the first
                               ///< leaf of each half; or, if the mask is 0, twice 1<<31 | log2 of
    ///< the edge of the empty cube: 4 for its own, 5 for its aligned 32³
    Buffer<uint32_t> leaves;       ///< 2 per leaf: mask low, mask high (of voxels)
    Buffer<uint32_t> leaf_voxels;  ///< first voxel of each leaf
    Buffer<uint32_t> attributes;   ///< one per voxel, see shared/voxel.h; see `attribute`
    uint32_t attribute = 0;        ///< packed attributes of every voxel if `attributes` is empty
    Buffer<uint32_t> colors;       ///< one per voxel
    Buffer<uint32_t> normals;      ///< one per voxel, as in BrickGrid
    bool transparent = false;      ///< true if some of the voxels aren't opaque
    bool cubes = true;             ///< as in BrickGrid
    Buffer<uint32_t> fields;     ///< 8 per voxel, see shared/voxel.h; empty without smooth surfaces
    uint32_t listed_fields = 0;  ///< number of records of fields, attributes and colours behind
                                 ///< those of voxels: for voxels that several surfaces pass
    bool has_chains = false;     ///< true if some listed fields are linked
    uint32_t chain_depth = 0;    ///< maximum depth of nested brackets in the fields' formulas
    Buffer<uint32_t> primitive_first;  ///< voxel_count + 1; empty without exact surfaces
    Buffer<uint32_t> primitives;       ///< this and the next eight are as in BrickGrid
    Buffer<float> triangles;
    Buffer<uint32_t> triangle_attributes;
    Buffer<uint32_t> triangle_normals;
    Buffer<uint32_t> triangle_textures;
    Buffer<uint32_t> textures;
    uint64_t texture_key = 0;
    bool texture_alpha = false, texture_maps = false;
    Buffer<uint32_t> solids;
    InstanceSet instances;
    SourceMeshes sources;
    Buffer<float> cube_steps;  ///< nine per scene object: runtime/analysis/cube_steps.hpp
    Buffer<uint32_t> order;  ///< coincidence_order() of each of the scene's objects; empty where no
                             ///< two exact surfaces can coincide
    std::vector<VoxelBox> object_boxes;  ///< the box around each of the scene's objects; empty if
                                         ///< unknown
    bool clear = false;  ///< true if the space between the voxels is known to hold no medium

    /// The number of records in `attributes`, `colors`, `normals` and (times 8) `fields`.
    uint32_t records() const { return voxel_count + listed_fields; }
};

}  // namespace voxelume
