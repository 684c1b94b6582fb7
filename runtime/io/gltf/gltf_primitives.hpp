// SPDX-License-Identifier: Apache-2.0
// The primitives of a glTF mesh that are read.
#pragma once

#include <algorithm>
#include <vector>

#include "runtime/io/gltf/gltf_file.hpp"

namespace voxelume {

/// True if a primitive is points or lines.
inline bool is_gltf_stroke(const GltfValue& primitive) {
    return primitive.count("mode", 4) < 4;
}

/// A mesh's primitives of triangles, or those of points and lines in a mesh without triangles.
/// Primitives without positions draw nothing, as the format says, and are left out.
inline std::vector<GltfValue> gltf_primitives(const GltfValue& mesh) {
    std::vector<GltfValue> found = mesh.items("primitives");
    std::erase_if(found, [](const GltfValue& primitive) {
        return !primitive.at("attributes").has("POSITION");
    });
    const bool has_faces = std::ranges::any_of(
        found, [](const GltfValue& primitive) { return !is_gltf_stroke(primitive); });
    if (has_faces) std::erase_if(found, is_gltf_stroke);
    return found;
}

}  // namespace voxelume
