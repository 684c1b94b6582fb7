// SPDX-License-Identifier: Apache-2.0
// The weights of a glTF file's morph targets.
#pragma once

#include <string>
#include <vector>

#include "runtime/io/gltf/gltf_animation.hpp"
#include "runtime/io/gltf/gltf_nodes.hpp"
#include "runtime/scene/parts/bounds.hpp"

namespace voxelume {

/// The weights of a node's mesh, and their animation.
struct GltfMorph {
    static constexpr int kMesh = -1, kNobody = -2;
    int owner = kNobody;              ///< number of the node that has the weights, or one of these
    std::vector<double> weights;      ///< empty: the mesh has no targets, or all weights are 0
    const Keyframes* keys = nullptr;  ///< keys of a clip; times are seconds
    int skin = -1;                    ///< number in the file; -1: none
    std::string clip;                 ///< clip that moves the skin's joints; empty if none does
};

/// The morph of a node that shows a mesh. Throws Error::input where the file has more or fewer
/// weights than targets.
GltfMorph gltf_morph(const GltfFile& file, const GltfClip& clip, const GltfNode& node);

/// `, "morph": {...}` of a model; empty without weights.
std::string morph_member(const GltfMorph& morph);

/// The track of the time by which a clip of `seconds` moves a model's skin.
std::string skin_track(const std::string& model, double seconds);

/// A box around a mesh that lies in `box`, over the weights of all keys and over its skin at each
/// of `frames` frames.
Bounds reach_of(const GltfMorph& morph, const GltfFile& file, int mesh, const Bounds& box,
                int frames);

}  // namespace voxelume
