// SPDX-License-Identifier: Apache-2.0
// frames of a scene -> the last use of each of its models
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The divisor that gives the part of a device's memory in which unused models are retained. Their
/// meshes may take as many bytes of main memory.
inline constexpr uint64_t kRetainedPart = 8;

/// For each model, one past the index in `frames` of the last frame that shows it; 0 if no frame
/// does. Throws as scene_at does.
std::vector<size_t> last_uses(const Scene& scene, std::span<const int> frames);

}  // namespace voxelume
