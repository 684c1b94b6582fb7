// SPDX-License-Identifier: Apache-2.0
// The moments at which the samples of an image are taken while a shutter is open.
#pragma once

#include <functional>

#include "runtime/scene/scene.hpp"
#include "runtime/world/world.hpp"

namespace voxelume {

/// The moments of one frame, which may throw as building worlds does.
struct Moments {
    /// The scene when a sample is taken; its settings are those of the whole run.
    std::function<Scene(int sample)> scene;
    /// The world of such a scene. It replaces the world before: references returned earlier show
    /// the new world from now on.
    std::function<const BuiltWorld&(Scene scene)> world;
};

}  // namespace voxelume
