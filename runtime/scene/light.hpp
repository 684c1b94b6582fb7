// A light as values.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

namespace voxelume {

enum class LightKind : uint8_t { point, spot, directional, disk, rectangle };

/// The most spots that one source of light is made of.
inline constexpr int kMaxSpots = 16384;

struct Light {
    std::string name;
    LightKind kind = LightKind::point;
    glm::dvec3 position{0};   ///< metres; all but directional; the centre of a disk or rectangle
    glm::dvec3 direction{0};  ///< unit vector along which the light travels; all but point
    glm::vec3 energy{1};      ///< colour times intensity: at 1 m, or everywhere for directional;
                              ///< of a disk or rectangle, along `direction` from far away
    double inner_half_angle = 0;  ///< radians; spot: full light up to here, ...
    double outer_half_angle = 0;  ///< ... none from here, between them smoothstep of the cosine
    double radius = 0;            ///< metres; disk
    glm::dvec2 size{0};           ///< metres; rectangle: along axis_x, and across it
    glm::dvec3 axis_x{0};         ///< unit vector across `direction`; disk and rectangle
    int spots = 64;               ///< disk and rectangle: points that they shine from
    std::string where;

    friend bool operator==(const Light&, const Light&) = default;
};

}  // namespace voxelume
