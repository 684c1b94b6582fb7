// SPDX-License-Identifier: Apache-2.0
// The channels from which an image is made, which may be more than those that are asked for.
#pragma once

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// True if an image has colour that isn't asked for, since its variance or a target of noise needs
/// it.
bool adds_color(const RenderSettings& render);

/// True if channels have points where sight rays meet something, and no other channel tells where
/// they do.
bool shows_points_alone(const ImageChannels& channels);

/// The channels that an image is made of: those that are asked for, and colour where it is added.
ImageChannels rendered_channels(const RenderSettings& render);

}  // namespace voxelume
