// SPDX-License-Identifier: Apache-2.0
// emissive surface -> light samples: parts of it that lie together and face the same way.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace voxelume {

/// A piece of emissive surface. Lengths are in metres.
struct EmissivePiece {
    glm::dvec3 position{0};  ///< from the world's first corner
    glm::dvec3 normal{0};    ///< unit vector
    double area = 0;         ///< > 0
    glm::dvec3 emission{0};  ///< radiance
    bool is_exact = true;    ///< true if the position lies on the surface, false if only near it
};

/// A part of the surface, with the position and normal of the piece that represents it.
struct LightSample {
    glm::dvec3 position{0};
    glm::dvec3 normal{0};
    double area = 0;      ///< area of the part
    glm::dvec3 power{0};  ///< sum of emission times area
};

/// Divides the pieces into `count` parts of about equal area, or into one part per piece if there
/// are fewer pieces.
///
/// The set is halved again and again across its longest side, where directions are scaled by the
/// whole emissive object's size to compare with positions. A part's light sample is the piece
/// closest to the part's mean. Reorders the pieces; ties follow their first order.
std::vector<LightSample> choose_light_samples(std::span<EmissivePiece> pieces, int count);

}  // namespace voxelume
