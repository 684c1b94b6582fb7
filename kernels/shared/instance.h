// SPDX-License-Identifier: Apache-2.0
// Objects that keep voxels of their own: rays are transformed into their space.
//
// Many instances share a model's voxels. The pyramids of all models follow the world's pyramid in
// the same buffers, and their indices refer to those buffers, so the start of its table of sectors
// identifies a model.
//
// The map from world voxels w to object voxels is image + object_from_world * (w - center). The
// difference w - center is exact for rays' origins nearby; a ray from farther away is transformed
// from its point closest to center.
#ifndef VXL_SHARED_INSTANCE_H
#define VXL_SHARED_INSTANCE_H

#define VXL_NO_INSTANCE 0xFFFFFFFFu  // as a hit's or path's instance: the world
#define VXL_INSTANCE_WORDS 36        // 32-bit words of a record
#define VXL_INSTANCE_OBJECT 32       // this and the next ones are words that lanes gather
#define VXL_INSTANCE_MATERIALS 33
#define VXL_INSTANCE_GROUPS 34

typedef struct InstanceRecord {
    float object_from_world[9];  // by rows
    float center[3];             // world voxels, whole
    float image[3];              // image of center, object voxels
    float low[3], high[3];       // the box that holds the model's voxels; object voxels, whole
    float near_squared;  // world voxels: rays closer to center are transformed from their origin
    float plane_bound;   // as in PyramidShape, like fixed_point, but for the walk in the object
    float fixed_point;
    int size[3];  // of the model's grid, voxels
    int sectors_x, sectors_y;
    unsigned int first_sector;    // where the model's table starts
    unsigned int aligned;         // 1: the map only turns by quarters, mirrors and moves by whole
                                  // voxels of the world's size, so rays are transformed exactly
    float bounds_rounding;        // world voxels: how far rounding moves the instance's faces
    unsigned int object;          // the object's number in the scene
    unsigned int first_material;  // where the materials of its groups start; the last one holds for
    unsigned int material_count;  // all further groups
    unsigned int padding;         // 0
} InstanceRecord;

// A node of the tree over the instances' boxes in the world, in world voxels. It has two children,
// each an inner node or, where VXL_INSTANCE_LEAF is set, an instance. An empty box (low > high) is
// no child.
#define VXL_INSTANCE_LEAF 0x80000000u
#define VXL_INSTANCE_DEPTH 32  // at most this many nodes from the root to a leaf

typedef struct InstanceNode {
    float low[2][3];
    float high[2][3];
    unsigned int child[2];
    unsigned int unused[2];  // 0
} InstanceNode;

typedef char InstanceRecordHas36Words[sizeof(InstanceRecord) == VXL_INSTANCE_WORDS * 4 ? 1 : -1];
typedef char InstanceNodeHas16Words[sizeof(InstanceNode) == 64 ? 1 : -1];

#endif
