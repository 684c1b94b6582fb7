// frames of a scene -> until when each of its models is shown.
#pragma once

#include <span>
#include <vector>

#include "runtime/scene.hpp"

namespace voxelume {

/// How many of `frames` have passed when the last that shows a model has, for each of the models; 0
/// for one that no frame shows. Throws as scene_at does.
std::vector<size_t> shown_until(const Scene& scene, std::span<const int> frames);

}  // namespace voxelume
