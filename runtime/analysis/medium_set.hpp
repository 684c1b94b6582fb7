// SPDX-License-Identifier: Apache-2.0
// The media that the rays of a scene may be inside of.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// The maximum number of objects in a ray's medium set, not counting the smooth body.
inline constexpr int kMaxMedia = 15;

/// Adds the features that depend on the positions of transmitting objects and of the observer.
void add_medium_set(const Scene& scene, const Pyramid& world, Features& features);

/// True if an observer's rays may begin inside a transmitting object. If none does, the first
/// surfaces that they meet are the same as if nothing transmitted light.
bool may_begin_inside(const Scene& scene, const Pyramid& world);

/// The features of a scene whose rays may begin anywhere in the world, as those for single voxels
/// do.
Features begun_anywhere(Features features, const Scene& scene);

}  // namespace voxelume
