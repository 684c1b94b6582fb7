// SPDX-License-Identifier: Apache-2.0
// Lights of a scene as plain structs.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "values.hpp"

namespace voxelume::v1 {

/// Shines from one point to all sides.
struct PointLight {
    Vec3 position{};  ///< metres
};

/// A cone of light; `direction` or `look_at` says where it goes.
struct SpotLight {
    Vec3 position{};                  ///< metres
    std::optional<Vec3> direction{};  ///< direction in which the light travels, of any length but 0
    std::optional<Vec3> look_at{};    ///< point that the light is aimed at, instead of a direction
    double angle = 60;                ///< degrees; opening of the whole cone, below 180
    std::optional<double> inner_angle{};  ///< degrees; opening of the cone with full light
};

/// Parallel light, such as the sun's.
struct DirectionalLight {
    Vec3 direction{};  ///< direction in which the light travels, of any length but 0
};

/// A disk that shines evenly to one side and is not seen itself.
struct DiskLight {
    Vec3 position{};                  ///< metres: its middle
    std::optional<Vec3> direction{};  ///< where the light travels; any length but 0
    std::optional<Vec3> look_at{};    ///< metres; a point to aim at, instead of a direction
    double radius = 0;                ///< metres, above 0
    int samples = 64;                 ///< points that it shines from, 1..16384
};

/// A rectangle that shines evenly to one side and is not seen itself.
struct RectangleLight {
    Vec3 position{};                  ///< metres: its middle
    std::optional<Vec3> direction{};  ///< where the light travels; any length but 0
    std::optional<Vec3> look_at{};    ///< metres; a point to aim at, instead of a direction
    std::array<double, 2> size{};     ///< metres: width, height
    std::optional<Vec3> up{};         ///< the direction that the height follows
    int samples = 64;                 ///< points that it shines from, 1..16384
};

/// A source of light.
struct Light {
    std::string name{};  ///< name for messages and tracks; empty: "lights[n]"
    /// Its type, with what that type needs.
    std::variant<PointLight, SpotLight, DirectionalLight, DiskLight, RectangleLight> source{};
    Color color{1, 1, 1};  ///< linear Rec. 709; the intensity multiplies it
    /// Light at 1 m, falling with the square; of directional light everywhere.
    double intensity = 1;
    /// Group whose part of an image Channels::light_groups shows; empty: none.
    std::string group{};
};

}  // namespace voxelume::v1
