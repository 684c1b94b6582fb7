// SPDX-License-Identifier: Apache-2.0
// The camera and the lights of a glTF file, as parts of a scene's text.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "runtime/io/gltf/gltf_nodes.hpp"
#include "runtime/scene/bounds.hpp"

namespace voxelume {

/// The observer of the file's first camera; empty where there is none. An image of another shape
/// than the camera's keeps its height.
std::string gltf_observer(const GltfFile& file, const std::vector<GltfNode>& nodes,
                          const Bounds& box, const glm::ivec2& size);

/// The file's lights, as bright in proportion to each other as they are there: together they give
/// the middle of the box an irradiance of 1, for files have them in candela and lux and say
/// nothing of exposure.
std::vector<std::string> gltf_light_items(const GltfFile& file, const std::vector<GltfNode>& nodes,
                                          const Bounds& box);

}  // namespace voxelume
