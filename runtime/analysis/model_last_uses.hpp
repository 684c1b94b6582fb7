// frames of a scene -> until when each of its models is shown.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The part of a device's memory that may keep what no frame shows just now, and as many bytes of
/// main memory its meshes.
inline constexpr uint64_t kRetainedPart = 8;

/// How many of `frames` have passed when the last that shows a model has, for each of the models; 0
/// for one that no frame shows. Throws as scene_at does.
std::vector<size_t> last_uses(const Scene& scene, std::span<const int> frames);

}  // namespace voxelume
