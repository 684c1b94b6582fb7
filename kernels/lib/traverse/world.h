// SPDX-License-Identifier: Apache-2.0
// The world as kernels take it: the pyramid of its voxels, the surfaces in these voxels, and the
// instances behind the pyramid.
#ifndef VXL_WORLD_H
#define VXL_WORLD_H

#include "lib/traverse/pyramid.h"
#include "shared/instance.h"
#include "shared/solid.h"

/// The parameters that runtime/grid/grid_arguments.hpp binds to a Pyramid, in its order.
#define VXL_WORLD_PARAMETERS                                                                       \
    PyramidShape shape, global const uint *restrict sectors, global const uint *restrict bricks,   \
        global const uint *restrict leaves, global const uint *restrict leaf_voxels,               \
        global const uint *restrict attributes, uint constant_attribute,                           \
        global const uint *restrict colors, global const uint *restrict voxel_normals,             \
        global const uint *restrict fields, global const uint *restrict primitive_first,           \
        global const uint *restrict primitives, global const float *restrict triangles,            \
        global const uint *restrict triangle_attributes,                                           \
        global const uint *restrict triangle_normals,                                              \
        global const uint *restrict triangle_textures, global const uint *restrict textures,       \
        global const SolidShape *restrict solids, uint solid_records,                              \
        global const uint *restrict order, global const InstanceRecord *restrict instance_records, \
        global const InstanceNode *restrict instance_nodes,                                        \
        global const uint *restrict group_materials

/// The surfaces in the voxels of a pyramid.
typedef struct {
    global const uint* restrict attributes;
    uint constant_attribute;  // of every voxel where there are no `attributes`
    global const uint* restrict colors;
    global const uint* restrict normals;  // of cubes, see shared/normal.h
    global const uint* restrict fields;
    global const uint* restrict primitive_first;
    global const uint* restrict primitives;
    global const float* restrict triangles;
    global const uint* restrict triangle_attributes;
    global const uint* restrict triangle_normals;
    global const uint* restrict triangle_textures;
    global const uint* restrict textures;
    global const SolidShape* restrict solids;
    uint solid_records;
    global const uint* restrict order;  // Pyramid::order; null where no surfaces can coincide
} SurfaceView;

/// The instances of models whose pyramids lie behind the world's.
typedef struct {
    global const InstanceRecord* restrict records;
    global const InstanceNode* restrict nodes;
    global const uint* restrict group_materials;
    // By objects' numbers: 0 for objects whose instances are left out. Null: all are shown.
    global const uint* restrict shown;
} InstanceView;

/// The whole world; buffers that it doesn't need are null.
typedef struct {
    PyramidShape shape;
    PyramidView pyramid;
    SurfaceView surface;
    InstanceView instances;
} WorldView;

/// The value of a WorldView in a kernel with these parameters.
#define VXL_WORLD                                                                               \
    {                                                                                           \
        shape, pyramid_view(shape, sectors, bricks, leaves, leaf_voxels), {attributes,          \
                                                                           constant_attribute,  \
                                                                           colors,              \
                                                                           voxel_normals,       \
                                                                           fields,              \
                                                                           primitive_first,     \
                                                                           primitives,          \
                                                                           triangles,           \
                                                                           triangle_attributes, \
                                                                           triangle_normals,    \
                                                                           triangle_textures,   \
                                                                           textures,            \
                                                                           solids,              \
                                                                           solid_records,       \
                                                                           order},              \
        {                                                                                       \
            instance_records, instance_nodes, group_materials, 0                                \
        }                                                                                       \
    }

#endif
