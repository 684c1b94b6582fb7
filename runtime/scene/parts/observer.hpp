// SPDX-License-Identifier: Apache-2.0
// The observer E as values. Its volumetric display VD_E is in display_shape.hpp.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "runtime/base/source_place.hpp"
#include "runtime/scene/parts/display_shape.hpp"
#include "runtime/scene/parts/value_row.hpp"

namespace voxelume {

/// The projection of an observer's flat images.
enum class Projection : uint8_t {
    display,       ///< through the display that the scene gives
    orthographic,  ///< by parallel rays: the display is the box to the end of the world
    panoramic      ///< all directions: the display is the ball to the end of the world
};

/// E: looks along +Z_E with Y_E up, so the right-hand side of the image is -X_E.
struct Observer {
    glm::dvec3 position{0};             ///< metres
    glm::dmat3 world_from_observer{1};  ///< rotation; its columns are X_E, Y_E, Z_E in the world
    double aperture = 0;  ///< metres: diameter of the lens; 0: flat images are sharp everywhere
    double focus = 0;     ///< metres along Z_E to the plane in focus
    int blades = 0;       ///< corners of the lens, from 3 on; 0: it is round
    double shutter = 0;   ///< number of frames for which the shutter is open, from a frame on; 0:
                          ///< only that moment
    Projection projection = Projection::display;
    Display display;
    SourcePlace where;

    friend bool operator==(const Observer&, const Observer&) = default;
};

/// The minimum sine of the angle between an observer's view direction and up.
inline constexpr double kMinUpSine = 1e-6;

/// The parameters of the observer's placement and display in a scene.
struct ObserverParameters {
    glm::dvec3 position{0};  ///< metres
    std::optional<glm::dvec3> look_at, up;
    std::optional<glm::dvec3> turn;       ///< degrees; instead of both
    double aperture = 0;                  ///< metres
    std::optional<double> focus;          ///< metres; otherwise the distance of `look_at`
    int blades = 0;                       ///< from 3 on; 0: round
    double shutter = 0;                   ///< frames
    std::optional<double> width, height;  ///< metres that an orthographic image shows
    DisplayParameters display;

    friend bool operator==(const ObserverParameters&, const ObserverParameters&) = default;
};

std::span<const ValueRow<ObserverParameters>> observer_rows();

/// Sets an observer's position and direction.
void place_observer(const ObserverParameters& parameters, const Refuse& refuse, Observer& observer);

/// Adapts a display with square pixels to the image's proportions, by the measure that follows
/// them.
void make_pixels_square(glm::dvec2 proportions, Display& display);

/// Sets shape and measures of the display of an observer whose projection decides them.
void project(const ObserverParameters& parameters, const DisplaySetting& setting,
             const Refuse& refuse, Observer& observer);

}  // namespace voxelume
