// emissive surface -> light samples: parts of it that lie together and face alike.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace voxelume {

/// A bit of emissive surface. Lengths in metres.
struct EmissivePiece {
    glm::dvec3 position{0};  ///< from the world's first corner
    glm::dvec3 normal{0};    ///< unit vector
    double area = 0;         ///< > 0
    glm::dvec3 emission{0};  ///< radiance
    bool is_exact = true;    ///< the position lies on the surface, not only near it
};

/// A part of the surface, and the piece that stands for it.
struct LightSample {
    glm::dvec3 position{0};
    glm::dvec3 normal{0};
    double area = 0;      ///< of the part
    glm::dvec3 power{0};  ///< sum of emission times area
};

/// Divides the pieces into `count` parts of about equal area, or as many as there are pieces.
///
/// The set is halved again and again, across the longest of its sides in space or, by the whole
/// emissive object's size, in direction. A part's light sample is the piece closest to its mean.
/// Reorders the pieces; their first order decides where all else is equal.
std::vector<LightSample> choose_light_samples(std::span<EmissivePiece> pieces, int count);

}  // namespace voxelume
