// SPDX-License-Identifier: Apache-2.0
// What an image is made of, which may be more than what is asked for.
#pragma once

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// True if an image has colour that isn't asked for, since its variance or a target of noise needs
/// it.
bool adds_color(const RenderSettings& render);

/// The channels that an image is made of: those that are asked for, and colour where it is added.
ImageChannels rendered_channels(const RenderSettings& render);

}  // namespace voxelume
