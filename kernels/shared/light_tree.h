// SPDX-License-Identifier: Apache-2.0
// A tree of lights, by which points of paths choose one of many.
#ifndef VXL_SHARED_LIGHT_TREE_H
#define VXL_SHARED_LIGHT_TREE_H

#ifdef __cplusplus
#include <kernels/shared/scene.h>
namespace voxelume {
#else
#include "shared/scene.h"
#endif

// Some of the lights. The children of node n are 2 n and 2 n + 1, the root is node 1, and the nodes
// of the last level have one light each or, with power 0, none.
typedef struct LightNode {
    float middle[3], radius;  // a ball around the lights: its middle in voxels of the world, which
                              // for one light is where it is, and its radius in metres
    float axis[3], cosine;    // a unit vector, and the cosine of the angle around it beyond which
                              // no light leaves; -2 where light may leave in any direction
    float power;              // of all lights together, as a share of the whole tree's
    float unused[3];
} LightNode;
#define VXL_NODE_RADIUS 3  // this and the next ones are words that lanes gather
#define VXL_NODE_AXIS 4
#define VXL_NODE_COSINE 7
#define VXL_NODE_POWER 8
#define VXL_NODE_WORDS 12
VXL_SIZE_IS(LightNode, 48);

// The nodes of one level of the tree are compared with each other, at most so many.
#define VXL_MOST_COMPARED_LEVEL 7
#define VXL_MOST_COMPARED_NODES 128

// The words of a LightRecord that lanes gather.
#define VXL_LIGHT_WORDS 16
#define VXL_LIGHT_POSITION 0
#define VXL_LIGHT_DIRECTION 4
#define VXL_LIGHT_INTENSITY 8
#define VXL_LIGHT_INNER_COSINE 12
#define VXL_LIGHT_OUTER_COSINE 13

// The words of a LightAreaRecord that lanes gather.
#define VXL_AREA_WORDS 8
#define VXL_AREA_AXIS_X 0
#define VXL_AREA_IS_ROUND 3
#define VXL_AREA_AXIS_Y 4
#define VXL_AREA_SIZE 7

#ifdef __cplusplus
}  // namespace voxelume
#endif

#endif
