// SPDX-License-Identifier: Apache-2.0
// adaptive image -> the image of its first samples, by which pixels are compared.
#pragma once

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The samples of a pixel before it is compared with others: its middle.
constexpr int kComparedSamples = 1;

/// How far from pixels that contrast others show a part of them, through the filter: pixels.
int contrast_reach(const RenderSettings& render);

/// True if some pixels of flat images get more samples than others, by their contrast.
bool is_adaptive(const RenderSettings& render);

/// The scene whose image is rendered first: with so few samples, with what pixels are compared by,
/// and, of a part of a picture, with the neighbours of all its pixels.
Scene first_samples_of(const Scene& scene);

/// The settings of the image whose hits may be retained: of an adaptive one that of its first
/// samples.
RenderSettings retained_settings(const Scene& scene);

}  // namespace voxelume
