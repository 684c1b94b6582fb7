// Points that share the area of a light evenly.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace voxelume {

/// The middles of `count` equal parts of a rectangle around the origin, halved across its longer
/// side again and again.
std::vector<glm::dvec2> points_of_rectangle(glm::dvec2 size, int count);

/// Vogel's spiral: points that share a disk evenly, each an angle of pi (3 - sqrt 5) on.
std::vector<glm::dvec2> points_of_disk(double radius, int count);

}  // namespace voxelume
