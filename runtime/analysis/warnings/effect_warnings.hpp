// SPDX-License-Identifier: Apache-2.0
// Warnings of settings that do nothing in a scene, because of others.
#pragma once

#include <vector>

#include "runtime/base/warning.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Adds the warnings of a frame's scattering, shutter, lens, filter, adaptive samples and target of
/// noise.
void add_effect_warnings(const Scene& scene, std::vector<Warning>& warnings);

}  // namespace voxelume
