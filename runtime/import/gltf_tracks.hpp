// SPDX-License-Identifier: Apache-2.0
// The motion of a glTF file's nodes, as places and tracks of a scene's text.
#pragma once

#include <string>
#include <vector>

#include "runtime/io/gltf/gltf_motion.hpp"

namespace voxelume {

/// The placement of an object and its animation.
struct GltfPlace {
    std::string members;  ///< keys of the object: `, "position": ...`; empty at the origin
    std::vector<std::string> tracks;  ///< items
};

/// The placement of a node that `motion` moves, in an object of this name. Each node with tracks
/// becomes the object's own placement or one of its parents, and has the file's own keys; nodes
/// between them become one matrix.
GltfPlace gltf_place(const GltfMotion& motion, const GltfNode& node, const std::string& object);

/// Rows of 4 numbers.
std::string matrix_text(const glm::dmat4& m);

/// Keys in seconds, as a track.
std::string keys_track(const std::string& target, const Keyframes& keys);

/// Values frame by frame, from frame 1 on, as a track.
std::string baked_track(const std::string& target, const std::vector<glm::dvec3>& values);

}  // namespace voxelume
