// The observer E and its volumetric display VD_E as values, and one descriptor row for each shape
// of the display.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "runtime/base/source_place.hpp"
#include "runtime/scene/value_row.hpp"

namespace voxelume {

enum class DisplayShape : uint8_t { pyramid, sector, ball, box };

enum class VolumeLayout : uint8_t {
    rays,    ///< (u, v, k): sight ray by step; u to the image's right, v down, k away from E
    lattice  ///< (x, y, z): Cartesian voxels along X_E, Y_E, Z_E, clipped by the display's shape
};

/// Which surfaces of the world a lattice shows.
enum class Visibility : uint8_t {
    observer,  ///< those that E sees
    outside,   ///< those that can be seen from somewhere outside of the world
    all        ///< all
};

/// VD_E, in the observer's coordinates. A ball is centred at the observer, the others lie around
/// Z_E.
struct Display {
    DisplayShape shape = DisplayShape::pyramid;
    glm::dvec2 half_angles{
        0};  ///< radians; pyramid: horizontal, vertical; sector: both the same, up to pi
    glm::dvec2 half_size{0};  ///< metres; box: half of its edges along X_E and Y_E
    double near = 0;  ///< metres, >= 0; pyramid and box: along Z_E; sector and ball: along the ray
    double far = 0;   ///< metres, > near; ball: its radius
    glm::ivec3 voxels{0};  ///< u, v, k
    bool square_pixels =
        false;  ///< pyramid given by one angle: the vertical one follows the image's size
    VolumeLayout layout = VolumeLayout::rays;
    Visibility visibility = Visibility::observer;  ///< always `observer` for rays
    bool cylinder = false;  ///< lattice: clipped by the upright cylinder that it circumscribes, too

    friend bool operator==(const Display&, const Display&) = default;
};

/// What half of the image spans, u and v: tangents for a pyramid, metres for a box, else radians.
glm::dvec2 half_extent(const Display& display);

/// The vertical half angle at which pixels of an image of this size are square.
double square_pixel_half_angle(double horizontal_half_angle, glm::ivec2 size);

/// E: looks along +Z_E with Y_E up, so the right-hand side of the image is -X_E.
struct Observer {
    glm::dvec3 position{0};             ///< metres
    glm::dmat3 world_from_observer{1};  ///< rotation; its columns are X_E, Y_E, Z_E in the world
    Display display;
    SourcePlace where;

    friend bool operator==(const Observer&, const Observer&) = default;
};

/// What a scene says of a display's shape, of all shapes.
struct DisplayParameters {
    std::optional<glm::dvec2> angles;  ///< degrees, from edge to edge
    std::optional<double> angle;       ///< likewise, both or the horizontal one
    double near = 0;                   ///< metres
    std::optional<double> far;         ///< metres; without one up to the end of the world
    double radius = 0;                 ///< metres
    glm::dvec3 size{0};                ///< metres

    friend bool operator==(const DisplayParameters&, const DisplayParameters&) = default;
};

/// What a scene says of where the observer stands and looks, and of the display.
struct ObserverParameters {
    glm::dvec3 position{0};  ///< metres
    std::optional<glm::dvec3> look_at, up;
    std::optional<glm::dvec3> turn;  ///< degrees; instead of both
    DisplayParameters display;

    friend bool operator==(const ObserverParameters&, const ObserverParameters&) = default;
};

std::span<const ValueRow<ObserverParameters>> observer_rows();
std::span<const ValueRow<DisplayParameters>> display_rows();

/// What a display's measures depend on besides its own.
struct DisplaySetting {
    double world_end;       ///< metres from the observer to the world's farthest corner
    glm::ivec2 image_size;  ///< pixels
};

struct DisplayShapeRow {
    DisplayShape shape;
    std::string_view name;          ///< in scene files
    std::span<const KindKey> keys;  ///< besides those that all displays have
    /// Sets the shape's measures, and refuses those that don't go together.
    void (*measure)(const DisplayParameters& parameters, const DisplaySetting& setting,
                    const Refuse& refuse, Display& display);
};

/// In the order of DisplayShape.
std::span<const DisplayShapeRow> display_shapes();

/// Sets where an observer stands and looks.
void place_observer(const ObserverParameters& parameters, const Refuse& refuse, Observer& observer);

}  // namespace voxelume
