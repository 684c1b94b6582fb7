// SPDX-License-Identifier: Apache-2.0
// The meshes that smooth objects with textures were made of. Rays that meet such an object show
// what the closest point of its mesh wears.
//
// One array of words holds the textures of all meshes, in the layout of exact triangles' textures
// (shared/texture.h); then, for each mesh, the nodes of a tree over the boxes of its triangles,
// their corners, and what they wear.
#ifndef VXL_SHARED_SOURCE_MESH_H
#define VXL_SHARED_SOURCE_MESH_H

#define VXL_NO_SOURCE 0xFFFFFFFFu  // as SourceRecord::nodes: the object has no source mesh
#define VXL_SOURCE_NODE_WORDS 16   // of an InstanceNode whose leaves are triangles
#define VXL_SOURCE_CORNER_WORDS 9  // the corners of a triangle, in the mesh's space

// The mesh of an object of the scene, by the object's number.
typedef struct SourceRecord {
    float mesh_from_voxels[12];  // three rows, from the voxels that its hits are in
    unsigned int nodes;          // index of its nodes among the words; the first is the root
    unsigned int triangles;      // index of its triangles' corners, in the order of the mesh
    unsigned int worn;           // index of VXL_WORN_WORDS per triangle; textures count from ...
    unsigned int textures;       // ... here
    float reach;                 // the largest distance of a closest point, in the mesh's space
    unsigned int unused[3];      // 0
} SourceRecord;

typedef char SourceRecordHas20Words[sizeof(SourceRecord) == 80 ? 1 : -1];

#endif
