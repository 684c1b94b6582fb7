// SPDX-License-Identifier: Apache-2.0
// image + tracks -> where each pixel's point was a frame before, and where it will be a frame
// later.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "runtime/image/image.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The position of a world's point in a scene's whole picture: columns from the left and rows from
/// the top, in pixels. Empty for points that no sight ray meets, such as those behind a pyramid.
std::optional<glm::dvec2> position_in_picture(const Scene& scene, const glm::dvec3& point);

/// Adds the planes forward.u, forward.v, backward.u and backward.v to an image with P and objectId
/// of a frame of `scene`: pixels to the right and up, as compositors count. They follow the tracks
/// of the observer and of objects' placements; shapes that change count as if they stood still.
/// Pixels that show nothing have 0.
void add_motion(const Scene& scene, int frame, Image& image);

/// Throws Error::usage for a scene whose images have samples of several moments.
void check_motion(const Scene& scene);

}  // namespace voxelume
