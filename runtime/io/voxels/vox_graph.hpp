// SPDX-License-Identifier: Apache-2.0
// Nodes of a .vox file's scene graph -> objects with their placements.
#pragma once

#include <cstdint>
#include <map>
#include <set>

#include "runtime/io/voxels/vox_chunks.hpp"
#include "runtime/io/voxels/vox_file.hpp"

namespace voxelume {

enum class VoxNodeKind : uint8_t { transform, group, shape };

struct VoxNode {
    VoxNodeKind kind = VoxNodeKind::group;
    std::string name;
    bool hidden = false;
    int layer = -1;
    std::vector<int> children;    ///< numbers of nodes
    std::vector<VoxPose> poses;   ///< poses of a transform node
    std::vector<VoxShown> shown;  ///< models of a shape node
};

struct VoxGraph {
    std::map<int, VoxNode> nodes;  ///< by their numbers; 0 is the root
    std::set<int> hidden_layers;
};

/// Takes a node of the kind with its number from a chunk.
void take_node(VoxNodeKind kind, VoxContent& content, VoxGraph& graph);

/// The objects of the graph, in its order; without nodes, one object for each model, on the ground.
/// Throws Error::input for references to missing nodes and models, and for cycles.
std::vector<VoxObject> objects_of(const VoxGraph& graph, const VoxFile& vox, const InputFile& file);

/// The rotation that a byte of the file encodes: bits 0-1 and 2-3 are the axes of the first two
/// rows, bits 4, 5 and 6 the signs of all three. Throws Error::input for an invalid byte.
VoxRotation vox_rotation(int byte, const VoxContent& content);

}  // namespace voxelume
