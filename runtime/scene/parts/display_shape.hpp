// SPDX-License-Identifier: Apache-2.0
// The volumetric display VD_E as values, and one descriptor row for each shape of it.
//
// A shape is added with an enumerator of DisplayShape, a row of display_shapes(), and its branch of
// the functions in kernels/lib/traverse/display_shape.h. CONTRIBUTING.md lists the other places.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "runtime/scene/parts/bounds.hpp"
#include "runtime/scene/parts/value_row.hpp"

namespace voxelume {

enum class DisplayShape : uint8_t { pyramid, sector, ball, box };

enum class VolumeLayout : uint8_t {
    rays,    ///< (u, v, k): sight ray by step; u to the image's right, v down, k away from E
    lattice  ///< (x, y, z): Cartesian voxels along X_E, Y_E, Z_E, clipped by the display's shape
};

/// The surfaces of the world that a lattice shows.
enum class Visibility : uint8_t {
    observer,  ///< surfaces that E sees
    outside,   ///< surfaces visible from somewhere outside of the world
    all        ///< all
};

/// The sight lines for which opacities are computed: along these, a lattice's voxels together cover
/// as much as the surfaces that they show.
enum class SeenAlong : uint8_t {
    observer,  ///< sight lines of E
    facing,    ///< lines along the axis that the surface faces most, voxel by voxel
    x,         ///< lines along X_E
    y,
    z
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
    glm::ivec3 voxels{0};        ///< u, v, k
    bool square_pixels = false;  ///< for flat images: of a pyramid's angles, or a box's sides, only
                                 ///< one is given and the other follows the image's proportions
    bool keeps_height = false;   ///< box with square pixels: its width follows from its height
    VolumeLayout layout = VolumeLayout::rays;
    Visibility visibility = Visibility::observer;  ///< always `observer` for rays
    SeenAlong seen_along = SeenAlong::observer;    ///< lattice
    bool cylinder = false;  ///< lattice: clipped by the upright cylinder that it circumscribes, too

    friend bool operator==(const Display&, const Display&) = default;
};

/// The parameters of a display's shape in a scene, for all shapes.
struct DisplayParameters {
    std::optional<glm::dvec2> angles;  ///< degrees, from edge to edge
    std::optional<double> angle;       ///< degrees: both angles, or the horizontal one
    double near = 0;                   ///< metres
    std::optional<double> far;         ///< metres; default: the end of the world
    double radius = 0;                 ///< metres
    glm::dvec3 size{0};                ///< metres

    friend bool operator==(const DisplayParameters&, const DisplayParameters&) = default;
};

std::span<const ValueRow<DisplayParameters>> display_rows();

/// The surroundings on which a display's measures depend.
struct DisplaySetting {
    double world_end;        ///< metres from the observer to the world's farthest corner
    glm::dvec2 proportions;  ///< proportions of the image's sides
};

/// The relation between pixels and sight rays.
enum class SightProjection : uint8_t {
    perspective,  ///< from the observer, evenly across a plane
    parallel,     ///< along Z_E
    angular       ///< from the observer, evenly by angle
};

/// Four flat sides and a near face around all sight rays of a display.
struct FlatSides {
    glm::dvec2 half;  ///< tangents, or metres where the rays are parallel
    double near;      ///< metres along Z_E
};

/// All properties that depend on a display's shape on the host. Points and boxes are in the
/// observer's coordinates, in metres.
struct DisplayShapeRow {
    DisplayShape shape;
    std::string_view name;  ///< in scene files and in the headers of volumetric images
    int kernel_number;      ///< VXL_SHAPE_* of kernels/shared/scene.h
    SightProjection projection;
    bool depth_is_along_z;          ///< otherwise depths count along the sight ray
    bool image_is_round;            ///< only the ellipse in the image has sight rays
    std::span<const KindKey> keys;  ///< in addition to those of all displays
    /// Sets the shape's measures, and refuses contradictory ones.
    void (*measure)(const DisplayParameters& parameters, const DisplaySetting& setting,
                    const Refuse& refuse, Display& display);
    /// The half extent of the image along u and v: tangents for a pyramid, metres for a box, else
    /// radians.
    glm::dvec2 (*half_extent)(const Display& display);
    /// The box around the shape.
    Bounds (*bounds)(const Display& display);
    /// The point at `depth` of the sight ray at (u, v) in [-1, 1], u to the right (-X_E) and v down
    /// (-Y_E).
    glm::dvec3 (*point_on_ray)(const Display& display, glm::dvec2 uv, double depth);
    /// The (u, v) of the sight ray through a point; nothing where there is none.
    std::optional<glm::dvec2> (*ray_through)(const Display& display, const glm::dvec3& point);
    /// True if every sight ray leads forwards, so that Z in image files can be the depth along Z_E.
    bool (*looks_ahead)(const Display& display);
    /// The distance from the observer within which sight rays begin.
    double (*start_radius)(const Display& display);
    /// The slopes of DisplayLattice, by which kernels clip a lattice to the shape.
    glm::dvec2 (*clip_slopes)(const Display& display);
    /// Four flat sides around all sight rays. Empty if only the ball with the radius `far` holds
    /// them.
    std::optional<FlatSides> (*flat_sides)(const Display& display);
    /// Widens the image about its middle by a factor for u and one for v; null if that is
    /// impossible.
    void (*widen)(Display& display, glm::dvec2 scale) = nullptr;
    /// Sets the measure that follows from the image's proportions; null without one.
    void (*make_square)(glm::dvec2 proportions, Display& display) = nullptr;
};

/// The rows in the order of DisplayShape.
std::span<const DisplayShapeRow> display_shapes();

const DisplayShapeRow& shape_row(const Display& display);

/// `half_extent` of the display's shape.
glm::dvec2 half_extent(const Display& display);

}  // namespace voxelume
