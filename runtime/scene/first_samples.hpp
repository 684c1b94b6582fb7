// SPDX-License-Identifier: Apache-2.0
// adaptive image -> the image of its first samples, by which pixels are compared.
#pragma once

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The number of samples of a pixel before it is compared with others: one in its middle.
constexpr int kComparedSamples = 1;

/// The distance, in pixels, up to which the filter shows parts of contrasting pixels in others.
int contrast_reach(const RenderSettings& render);

/// True if pixels of flat images get more samples where they contrast with others.
bool is_adaptive(const RenderSettings& render);

/// The scene of the first image: with kComparedSamples samples, with the channels by which pixels
/// are compared, and, for a part of a picture, with the neighbours of all its pixels.
Scene first_samples_of(const Scene& scene);

/// The settings of the image whose hits may be retained: of an adaptive image, that of its first
/// samples.
RenderSettings retained_settings(const Scene& scene);

}  // namespace voxelume
