// SPDX-License-Identifier: Apache-2.0
// The nodes of a glTF file's scene, each with its way into the world.
#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "runtime/io/gltf/gltf_file.hpp"

namespace voxelume {

/// A node that shows something, or one of its instances.
struct GltfNode {
    std::string name;  ///< the node's, or else that of what it shows; may be empty
    glm::dmat4 world_from_node{1};
    int mesh = -1, camera = -1, light = -1;  ///< numbers in the file; -1: none
};

/// The most nodes and instances of a file that show something.
inline constexpr size_t kMaxGltfNodes = 50'000;

/// The nodes of the scene that the file shows: its own choice, or the first, or without scenes all
/// nodes. Nodes that show nothing are left out. Throws Error::input for a node that is its own
/// ancestor or has two parents, Error::limit for more than kMaxGltfNodes.
std::vector<GltfNode> gltf_nodes(const GltfFile& file);

/// The lights of KHR_lights_punctual.
std::vector<GltfValue> gltf_lights(const GltfFile& file);

}  // namespace voxelume
