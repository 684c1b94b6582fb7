// SPDX-License-Identifier: Apache-2.0
// The sky around the world. Rays that leave the world see it, and it lights surfaces.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "runtime/base/source_place.hpp"
#include "runtime/scene/parts/sky_map.hpp"
#include "runtime/scene/parts/value_row.hpp"

namespace voxelume {

enum class SkyKind : uint8_t { constant, gradient, sun, map };

struct Sky {
    SkyKind kind = SkyKind::constant;
    glm::vec3 color{1};                     ///< constant: radiance; of the sun: its colour
    glm::vec3 zenith{0.25f, 0.45f, 0.9f};   ///< gradient: radiance from above ...
    glm::vec3 horizon{0.8f, 0.9f, 1.0f};    ///< ... and from the side; between them by the sine
    glm::vec3 ground{0.25f, 0.23f, 0.21f};  ///< gradient, sun: radiance from below the horizon
    double strength = 1;                    ///< multiplies the radiance, but for the sun's disc
    int samples = 16;     ///< directions in which a point in local light samples the sky
    bool visible = true;  ///< to observers; otherwise they see the background
    // the sun, in a clear sky:
    glm::dvec3 direction{0, -1, 0};  ///< unit vector along which its light travels; downwards
    double angle = 0.53;             ///< degrees that the disc fills
    double intensity = 1;            ///< strength of the light from the disc
    double turbidity = 3;            ///< haze: 2 clear .. 10 thick
    // a map, the picture of a sky:
    std::filesystem::path file{};  ///< .exr, .hdr or .png
    double rotation = 0;           ///< degrees, counterclockwise as seen from above
    SkyMapPlace map{};             ///< the loaded picture
    SourcePlace where{};           ///< position of the file's name

    friend bool operator==(const Sky&, const Sky&) = default;
};

/// A kind of sky, in the order of SkyKind.
struct SkyType {
    std::string_view name;  ///< in scene files
    std::span<const KindKey> keys;
};
std::span<const SkyType> sky_types();

std::span<const ValueRow<Sky>> sky_rows();

/// Makes the sun's direction a unit vector; refuses a sun below the horizon.
void check_sky(Sky& sky, const Refuse& refuse);

}  // namespace voxelume
