// SPDX-License-Identifier: Apache-2.0
// The light around a file's content and the background behind it, as the file says.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

namespace voxelume {

struct FileLight {
    std::optional<glm::dvec3> to_sun;      ///< unit vector; none: over the observer's left shoulder
    glm::dvec3 sun{0};                     ///< irradiance of a plane that faces the sun
    double sun_spread = 0;                 ///< degrees, half of the angle that the sun fills
    glm::dvec3 sky{0};                     ///< radiance from everywhere
    std::optional<glm::dvec3> background;  ///< radiance; none: the studio's
    bool has_ground = true;
    std::optional<glm::dvec3> ground;  ///< its colour; none: one that looks like the background
    glm::dvec3 fog{0};                 ///< absorption per metre
    glm::dvec3 fog_color{0};           ///< radiance
};

}  // namespace voxelume
