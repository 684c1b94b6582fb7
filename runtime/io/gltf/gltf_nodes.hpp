// SPDX-License-Identifier: Apache-2.0
// The nodes of a glTF file's scene, each with its map into the world.
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
    int number = 0;                    ///< number of the node in the file
    glm::dmat4 node_from_instance{1};  ///< map of EXT_mesh_gpu_instancing; part of world_from_node
    int mesh = -1, camera = -1, light = -1;  ///< numbers in the file; -1: none
    int skin = -1;  ///< number in the file; its joints, not the node, place the mesh
};

/// The maximum number of a file's nodes and instances that show something.
inline constexpr size_t kMaxGltfNodes = 50'000;

/// The nodes of the scene that the file shows: its own choice, or the first, or without scenes all
/// nodes. Nodes that show nothing are left out. Throws Error::input for a node that is its own
/// ancestor or has two parents, Error::limit for more than kMaxGltfNodes.
std::vector<GltfNode> gltf_nodes(const GltfFile& file);

/// The number of each node's parent; -1 for roots of the scene and nodes outside it. Throws as
/// gltf_nodes() does.
std::vector<int> gltf_parents(const GltfFile& file);

/// The placement of a node without tracks.
glm::dvec3 gltf_translation(const GltfValue& node);
glm::dvec4 gltf_rotation(const GltfValue& node);  ///< a quaternion x, y, z, w
glm::dvec3 gltf_scale(const GltfValue& node);
/// The node's map, from its translation, rotation and scale, or from its matrix.
glm::dmat4 gltf_parent_from_node(const GltfValue& node);

/// True if some primitive of a mesh with triangles has joints, so that a skin moves it.
bool has_gltf_joints(const GltfValue& mesh);

/// The lights of KHR_lights_punctual.
std::vector<GltfValue> gltf_lights(const GltfFile& file);

}  // namespace voxelume
