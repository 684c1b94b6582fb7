// SPDX-License-Identifier: Apache-2.0
// Clips of a glTF file -> values of nodes over time.
#pragma once

#include <string>
#include <vector>

#include "runtime/io/gltf/gltf_file.hpp"
#include "runtime/scene/keyframes.hpp"

namespace voxelume {

/// The value of a node that a track changes.
enum class GltfPath : uint8_t { translation, rotation, scale, weights };

/// A value of a node over time.
struct GltfTrack {
    int node = 0;  ///< number in the file
    GltfPath path = GltfPath::translation;
    Keyframes keys;  ///< frames are seconds; rotations are quaternions
};

/// A clip, which the format calls an animation.
struct GltfClip {
    std::string name;
    double seconds = 0;  ///< the time of the last key
    std::vector<GltfTrack> tracks;
};

/// The name of each clip, made unique: its own, or "clip 2".
std::vector<std::string> gltf_clip_names(const GltfFile& file);

/// Reads a clip by its number. Channels without a node, and those of other paths, are left out.
/// Throws Error::input for accessors that don't go together, for numbers that aren't finite, and
/// for times that don't increase.
GltfClip gltf_clip(const GltfFile& file, size_t number);

}  // namespace voxelume
