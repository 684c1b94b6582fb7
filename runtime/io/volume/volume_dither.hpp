// SPDX-License-Identifier: Apache-2.0
// Light -> one of the few levels of a display's voxel.
#pragma once

#include <glm/vec3.hpp>

#include "runtime/io/volume/volume_options.hpp"

namespace voxelume {

/// The threshold of a display voxel, in (0, 1): (rank + 0.5) / 64 with the ranks of Bayer's 8 x 8
/// matrix (1973). The matrix is shifted by (3, 5) from plane to plane so that no line of voxels
/// stays dark. Without dithering the threshold is 0.5.
float threshold_at(Dither dither, int column, int row, int plane);

/// The level, 0 .. `maximum`, of a value in 0..1. It is the next higher level where the fraction
/// above the lower one exceeds the threshold.
int level_of(float value, int maximum, float threshold);

/// The light of a voxel as a display adds it up: colour times opacity times 2^exposure, clamped to
/// 0..1.
glm::vec3 light_of(const glm::vec3& color, float opacity, float exposure);

/// The Rec. 709 luminance of linear light.
float luminance(const glm::vec3& light);

/// The sRGB code of a linear value in 0..1, scaled to 0..1.
float srgb_share(float linear);

}  // namespace voxelume
