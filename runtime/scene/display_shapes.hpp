// One descriptor row for each shape of the display, and the observer's values that may change.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "runtime/scene/observer.hpp"
#include "runtime/scene/value_row.hpp"
#include "runtime/scene/world.hpp"

namespace voxelume {

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

/// Metres from a position to the farthest corner of the world's voxels.
double distance_to_farthest_corner(const World& world, const glm::dvec3& position);

}  // namespace voxelume
