// SPDX-License-Identifier: Apache-2.0
// world, or the model of an instance -> the pieces of its emissive objects' surfaces.
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/solid/solid.h"
#include "lib/solid/solid_surface.h"
#include "lib/surface/field.h"
#include "lib/surface/project.h"
#include "lib/traverse/world.h"
#include "shared/light_samples.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "shared/voxel.h"

/// The number of bits set below `bit` in a 64-bit mask.
static inline uint bits_below(uint low, uint high, uint bit) {
    const uint all = bit < 32 ? low : high;
    return popcount(all & ((1u << (bit & 31)) - 1u)) + (bit < 32 ? 0u : popcount(low));
}

static inline bool has_bit(uint low, uint high, uint bit) {
    return ((bit < 32 ? low : high) >> (bit & 31) & 1u) != 0u;
}

static inline uint attributes_of_voxel(const SurfaceView* s, uint voxel) {
    return VXL_ATTRIBUTES ? s->attributes[voxel] : s->constant_attribute;
}

static inline bool is_cube_kind(uint kind) {
    return kind == VXL_KIND_CUBES || kind == VXL_KIND_EXACT_IN_CUBE;
}

/// True if a cube fills the cell, or if the cell lies outside the world. Cells outside a model are
/// not covered.
static inline bool is_covered(const WorldView* world, bool is_model, int x, int y, int z) {
    const PyramidView* p = &world->pyramid;
    if (x < 0 || y < 0 || z < 0) return !is_model;
    if (x >= p->size_x || y >= p->size_y || z >= p->size_z) return !is_model;
    const uint entry = p->sectors[((z >> 6) * p->sectors_y + (y >> 6)) * p->sectors_x + (x >> 6)];
    if ((int)entry < 0) return false;
    const uint brick = (uint)((x >> 4 & 3) | (y >> 4 & 3) << 2 | (z >> 4 & 3) << 4);
    global const uint* record = p->bricks + ((size_t)entry * 64 + brick) * 4;
    const uint in_brick = (uint)((x >> 2 & 3) | (y >> 2 & 3) << 2 | (z >> 2 & 3) << 4);
    if (!has_bit(record[0], record[1], in_brick)) return false;
    const uint leaf = record[2] + bits_below(record[0], record[1], in_brick);
    const uint low = p->leaves[2 * leaf], high = p->leaves[2 * leaf + 1];
    const uint in_leaf = (uint)((x & 3) | (y & 3) << 2 | (z & 3) << 4);
    if (!has_bit(low, high, in_leaf)) return false;
    const uint voxel = p->leaf_voxels[leaf] + bits_below(low, high, in_leaf);
    return is_cube_kind(attributes_of_voxel(&world->surface, voxel) >> VXL_KIND_SHIFT);
}

/// The emissive surfaces to list. The first two tables hold one flag per object and one per
/// material. `found` counts all pieces; the first `capacity` of them are listed, in no particular
/// order.
typedef struct {
    global const uint* restrict emissive_objects;
    global const uint* restrict emissive_materials;
    uint capacity;
    bool by_voxel;  // lists voxels with emissive surfaces instead of their pieces
    bool is_model;  // the voxels are those of an instance's model, not the world's
    global uint* restrict found;
    global uint4* restrict pieces;
} EmissivePieces;

/// True if a surface with these packed attributes belongs to an emissive object and emits light.
static inline bool emits(const EmissivePieces* g, uint packed) {
    return g->emissive_objects[packed & VXL_OBJECT_MASK] != 0u &&
           g->emissive_materials[packed >> VXL_MATERIAL_SHIFT & VXL_MATERIAL_MASK] != 0u;
}

/// Lists a piece of form `form` in voxel (x,y,z). `number` is that of its voxel, field or solid.
static inline void list_piece(const EmissivePieces* g, int x, int y, int z, uint form, uint number,
                              uint packed) {
    const uint slot = atomic_inc(g->found);
    if (slot < g->capacity)
        g->pieces[slot] = (uint4)((uint)x | (uint)y << 16, (uint)z | form << 16, number, packed);
}

/// The sides of a cube that no other cube covers, as bits.
static inline uint open_sides(const WorldView* world, const EmissivePieces* g, int x, int y,
                              int z) {
    uint sides = 0;
    for (int face = 0; face < 6; ++face) {
        const int axis = face >> 1, step = (face & 1) * 2 - 1;
        if (!is_covered(world, g->is_model, x + (axis == 0 ? step : 0), y + (axis == 1 ? step : 0),
                        z + (axis == 2 ? step : 0)))
            sides |= 1u << face;
    }
    return sides;
}

/// Lists the open faces of a cube.
static inline void list_faces(const WorldView* world, const EmissivePieces* g, int x, int y, int z,
                              uint voxel, uint packed) {
    const uint sides = open_sides(world, g, x, y, z);
    for (uint face = 0; face < 6; ++face)
        if (sides >> face & 1u) list_piece(g, x, y, z, face, voxel, packed);
}

#define VXL_NO_EMISSION 0xFFFFFFFFu

/// The packed attributes of a voxel's first emissive triangle or solid, or VXL_NO_EMISSION.
static inline uint first_emission(const SurfaceView* s, const EmissivePieces* g, uint voxel) {
    for (uint i = s->primitive_first[voxel]; i < s->primitive_first[voxel + 1]; ++i) {
        const uint number = s->primitives[i];
        const uint of = number & VXL_SOLID_PRIMITIVE
                            ? s->solids[number & ~VXL_SOLID_PRIMITIVE].attribute
                            : s->triangle_attributes[number];
        if (emits(g, of)) return of;
    }
    return VXL_NO_EMISSION;
}

/// Lists a voxel under the numbers that hits on its emissive surfaces have: the voxel's or its
/// fields'.
static inline void list_emitter(const WorldView* world, const EmissivePieces* g, int x, int y,
                                int z, uint voxel, uint packed) {
    const SurfaceView* s = &world->surface;
    const uint kind = packed >> VXL_KIND_SHIFT;
    if (VXL_CUBES && kind == VXL_KIND_CUBES && emits(g, packed)) {
        const uint sides = open_sides(world, g, x, y, z);
        if (sides) list_piece(g, x, y, z, sides | VXL_EMITTER_OF_CUBES, voxel, packed);
    }
    if (VXL_SMOOTH && kind == VXL_KIND_SMOOTH && emits(g, packed))
        list_piece(g, x, y, z, VXL_EMITTER_SIDES_ALL, voxel, packed);
    if (kind < VXL_KIND_EXACT) return;
    if (VXL_FIELD_LISTS) {
        const uint2 list = vload2(0, s->fields + (size_t)voxel * VXL_FIELD_WORDS);
        for (uint field = list.x; field < list.x + list.y; ++field)
            if (emits(g, s->attributes[field]))
                list_piece(g, x, y, z, VXL_EMITTER_SIDES_ALL, field, s->attributes[field]);
    }
    uint of = VXL_EXACT ? first_emission(s, g, voxel) : VXL_NO_EMISSION;
    if (VXL_CUBES && kind == VXL_KIND_EXACT_IN_CUBE && emits(g, packed)) of = packed;
    if (of != VXL_NO_EMISSION) list_piece(g, x, y, z, VXL_EMITTER_SIDES_ALL, voxel, of);
}

/// Lists the emissive surfaces in one voxel.
static inline void list_voxel(const WorldView* world, const EmissivePieces* g, int x, int y, int z,
                              uint voxel) {
    const SurfaceView* s = &world->surface;
    const uint packed = attributes_of_voxel(s, voxel);
    const uint kind = packed >> VXL_KIND_SHIFT;
    if (g->by_voxel) {
        list_emitter(world, g, x, y, z, voxel, packed);
        return;
    }
    // A cube that shares its voxel with other surfaces lists no faces: those surfaces cover them.
    if (VXL_CUBES && kind == VXL_KIND_CUBES && emits(g, packed))
        list_faces(world, g, x, y, z, voxel, packed);
    if (VXL_SMOOTH && kind == VXL_KIND_SMOOTH && emits(g, packed))
        list_piece(g, x, y, z, VXL_PIECE_FIELD, voxel, packed);
    if (VXL_FIELD_LISTS && kind >= VXL_KIND_EXACT) {
        const uint2 list = vload2(0, s->fields + (size_t)voxel * VXL_FIELD_WORDS);
        for (uint field = list.x; field < list.x + list.y; ++field)
            if (emits(g, s->attributes[field]))
                list_piece(g, x, y, z, VXL_PIECE_FIELD, field, s->attributes[field]);
    }
    if (!VXL_SOLIDS || kind < VXL_KIND_EXACT) return;
    for (uint i = s->primitive_first[voxel]; i < s->primitive_first[voxel + 1]; ++i) {
        if (!(s->primitives[i] & VXL_SOLID_PRIMITIVE)) continue;
        const uint solid = s->primitives[i] & ~VXL_SOLID_PRIMITIVE;
        if (emits(g, s->solids[solid].attribute))
            list_piece(g, x, y, z, VXL_PIECE_SOLID, solid, s->solids[solid].attribute);
    }
}

/// Lists the emissive surfaces in one brick: the open faces of cubes, smooth voxels, and solids in
/// the voxels that list them. One work-item takes one of each sector's 64 bricks. The table of
/// sectors begins at `first_sector`, which is 0 for the world and larger for a model. With
/// `by_voxel`, lists the voxels of these surfaces instead.
kernel void list_emissive(const uint count, VXL_WORLD_PARAMETERS, const uint first_sector,
                          global const uint* restrict emissive_objects,
                          global const uint* restrict emissive_materials, const uint by_voxel,
                          const uint capacity, global uint* restrict found,
                          global uint4* restrict pieces) {
    const uint item = work_item();
    if (item >= count) return;
    WorldView world = VXL_WORLD;
    world.pyramid.sectors += first_sector;
    const EmissivePieces asked = {emissive_objects,
                                  emissive_materials,
                                  capacity,
                                  by_voxel != 0u,
                                  first_sector > 0u,
                                  found,
                                  pieces};
    const int sector = (int)(item >> 6), brick = (int)(item & 63u);
    const uint entry = world.pyramid.sectors[sector];
    if ((int)entry < 0) return;
    global const uint* record = bricks + ((size_t)entry * 64 + brick) * 4;
    const int row = sector / shape.sectors_x;
    const int x0 = (sector - row * shape.sectors_x) * 64 + (brick & 3) * 16;
    const int y0 = (row % shape.sectors_y) * 64 + (brick >> 2 & 3) * 16;
    const int z0 = (row / shape.sectors_y) * 64 + (brick >> 4) * 16;
    uint leaf = record[2];
    for (int child = 0; child < 64; ++child) {
        if (!has_bit(record[0], record[1], (uint)child)) continue;
        uint voxel = leaf_voxels[leaf];
        const uint low = leaves[2 * leaf], high = leaves[2 * leaf + 1];
        ++leaf;
        for (int bit = 0; bit < 64; ++bit) {
            if (!has_bit(low, high, (uint)bit)) continue;
            list_voxel(&world, &asked, x0 + (child & 3) * 4 + (bit & 3),
                       y0 + (child >> 2 & 3) * 4 + (bit >> 2 & 3),
                       z0 + (child >> 4) * 4 + (bit >> 4), voxel);
            ++voxel;
        }
    }
}

/// Finds the surface in each piece's voxel, near its middle. Writes seven components, `stride`
/// values apart: the point within the voxel; the gradient of the distance there, along the grid's
/// axes, in voxels; and the point's distance from the surface, in voxels. Leaves out cubes.
kernel void find_surface(PyramidShape shape, const uint count, const uint stride,
                         global const uint* restrict pieces, global const uint* restrict fields,
                         global const SolidShape* restrict solids, global float* restrict found) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const lane_uint index =
        min((lane_uint)first + LANES_AS_UINT((lane_int)LANES_NUMBERS), (lane_uint)(count - 1u)) *
        4u;
    const lane_uint xy = LANES_GATHER_UINT(pieces, index);
    const lane_uint z_form = LANES_GATHER_UINT(pieces, index + 1u);
    const lane_uint number = LANES_GATHER_UINT(pieces, index + 2u);
    const lane_uint form = z_form >> 16;
    const lane_float half_way = (lane_float)0.5f, none = (lane_float)0.0f;
    Vector p = {half_way, half_way, half_way}, g = {none, none, none};
    lane_float left = (lane_float)INFINITY;
    const lane_int is_field = LANE_MASK(form == VXL_PIECE_FIELD);
    if (VXL_SMOOTH && lanes_any(is_field)) {
        const Field f = read_field(fields, number & LANES_AS_UINT(is_field));
        Vector at = p, slope = g;
        lane_float rest = left;
        project_on_field(&f, &at, &slope, &rest);
        p = select_vector(is_field, at, p);
        g = select_vector(is_field, slope, g);
        left = LANES_SELECT(is_field, rest, left);
    }
    lane_int solid = VXL_SOLIDS ? LANE_MASK(form == VXL_PIECE_SOLID) : (lane_int)0;
    while (VXL_SOLIDS && lanes_any(solid)) {
        const uint one = lanes_min(LANES_SELECT(solid, number, (lane_uint)0xFFFFFFFFu));
        const lane_int same = solid & LANE_MASK(number == one);
        solid &= ~same;
        Vector at = {half_way, half_way, half_way}, slope = g;
        lane_float rest = left;
        project_on_solid(shape, solids, one, LANES_AS_INT(xy & 0xFFFFu), LANES_AS_INT(xy >> 16),
                         LANES_AS_INT(z_form & 0xFFFFu), &at, &slope, &rest);
        p = select_vector(same, at, p);
        g = select_vector(same, slope, g);
        left = LANES_SELECT(same, rest, left);
    }
    store_vector(p, found, stride, first);
    store_vector(g, found + 3 * stride, stride, first);
    LANES_STORE(left, found, 6 * stride + first);
}
