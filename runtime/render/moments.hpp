// SPDX-License-Identifier: Apache-2.0
// What the samples of an image show that are taken at several moments, while a shutter is open.
#pragma once

#include <functional>

#include "runtime/scene/scene.hpp"
#include "runtime/world/world.hpp"

namespace voxelume {

/// The moments of one frame, which may throw as building worlds does.
struct Moments {
    /// The scene when a sample is taken; its settings are those of the whole run.
    std::function<Scene(int sample)> scene;
    /// The world of such a scene. It takes the place of the one before: what was returned then
    /// shows this one from now on.
    std::function<const BuiltWorld&(Scene scene)> world;
};

}  // namespace voxelume
