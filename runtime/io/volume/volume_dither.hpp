// Light -> the few levels that a display's voxel has.
#pragma once

#include <glm/vec3.hpp>

#include "runtime/io/volume/volume_options.hpp"

namespace voxelume {

/// The threshold of a display voxel, in (0, 1): (rank + 0.5) / 64 with the ranks of Bayer's 8 x 8
/// matrix (1973), shifted by (3, 5) from plane to plane so that no line of voxels stays dark; 0.5
/// without dithering.
float threshold_at(Dither dither, int column, int row, int plane);

/// The level of 0 .. `maximum` for a value of 0..1: the next higher one where the rest is above the
/// threshold.
int level_of(float value, int maximum, float threshold);

/// A voxel's light as a display adds it up: colour times opacity times 2^exposure, cut to 0..1.
glm::vec3 light_of(const glm::vec3& color, float opacity, float exposure);

/// Rec. 709 luminance.
float luminance(const glm::vec3& light);

/// The sRGB code of a value of 0..1, as a part of 1.
float srgb_share(float linear);

}  // namespace voxelume
