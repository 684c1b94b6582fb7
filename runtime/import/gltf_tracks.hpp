// SPDX-License-Identifier: Apache-2.0
// The motion of a glTF file's nodes, as places and tracks of a scene's text.
#pragma once

#include <string>
#include <vector>

#include "runtime/io/gltf/gltf_motion.hpp"

namespace voxelume {

/// Where an object stands, and what moves it.
struct GltfPlace {
    std::string members;              ///< of the object: `, "position": ...`; empty at the origin
    std::vector<std::string> tracks;  ///< items
};

/// The place of a node that `motion` moves, in an object of such a name. Each node with tracks is
/// the object's own place or one of its parents, and has the file's own keys; what lies between is
/// one matrix.
GltfPlace gltf_place(const GltfMotion& motion, const GltfNode& node, const std::string& object);

/// Rows of 4 numbers.
std::string matrix_text(const glm::dmat4& m);

/// Keys in seconds, as a track.
std::string keys_track(const std::string& target, const Keyframes& keys);

/// Values frame by frame, from frame 1 on, as a track.
std::string baked_track(const std::string& target, const std::vector<glm::dvec3>& values);

}  // namespace voxelume
