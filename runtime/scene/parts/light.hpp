// SPDX-License-Identifier: Apache-2.0
// A light as values, and one descriptor row for each type of light.
//
// A type is added with an enumerator of LightKind, a row of light_types(), and the branches for its
// `shading` number in kernels/lib/light/direct_light.h. CONTRIBUTING.md lists the other places.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/source_place.hpp"
#include "runtime/scene/parts/value_row.hpp"

namespace voxelume {

enum class LightKind : uint8_t { point, spot, directional, disk, rectangle };

/// The maximum number of light samples of one light or emissive object.
inline constexpr int kMaxLightSamples = 16384;

struct Light {
    std::string name;
    LightKind kind = LightKind::point;
    glm::dvec3 position{0};   ///< metres; all but directional; the centre of a disk or rectangle
    glm::dvec3 direction{0};  ///< unit vector along which the light travels; all but point
    glm::vec3 intensity{1};   ///< colour times intensity: at 1 m, or everywhere for directional; of
                              ///< a disk or rectangle, along `direction` from far away
    double inner_half_angle = 0;  ///< radians; spot: full light up to here, ...
    double outer_half_angle = 0;  ///< ... none from here, between them smoothstep of the cosine
    double radius = 0;            ///< metres; disk
    glm::dvec2 size{0};           ///< metres; rectangle: along axis_x, and across it
    glm::dvec3 axis_x{0};         ///< unit vector across `direction`; disk and rectangle
    int light_samples = 64;       ///< disk and rectangle: number of points that shine
    SourcePlace where;
    std::string group;  ///< the light's group, which may have a channel; empty: none
    /// True for a light that brings no light, but that points which choose one of many lights may
    /// choose all the same: so images of parts of the light choose like the image of all light. Not
    /// in scene files.
    bool is_dark = false;

    friend bool operator==(const Light&, const Light&) = default;
};

/// The parameters of a light in a scene, for all types.
struct LightParameters {
    glm::dvec3 position{0};               ///< metres
    std::optional<glm::dvec3> direction;  ///< direction of any length but 0
    std::optional<glm::dvec3> look_at;    ///< metres; a point instead of a direction
    std::optional<glm::dvec3> up;
    glm::vec3 color{1};
    double intensity = 1;
    std::optional<double> angle;        ///< degrees, from edge to edge
    std::optional<double> inner_angle;  ///< degrees, from edge to edge of the full light
    double radius = 0;                  ///< metres
    glm::dvec2 size{0};                 ///< metres
    int light_samples = 64;

    friend bool operator==(const LightParameters&, const LightParameters&) = default;
};

std::span<const ValueRow<LightParameters>> light_rows();

/// The properties of a type of light with an area.
struct LightArea {
    double (*area)(const Light&);           ///< square metres
    double (*radius)(const Light&);         ///< metres: no point lies farther from `position`
    glm::dvec2 (*half_axes)(const Light&);  ///< metres: half its extent along axis_x and across it
    bool is_round;  ///< the area is an ellipse with these half axes, not a rectangle
    /// Points that share the area evenly, `light_samples` of them: metres along axis_x and across
    /// it.
    std::vector<glm::dvec2> (*points)(const Light&);
};

struct LightType {
    LightKind kind;
    std::string_view name;          ///< in scene files
    std::span<const KindKey> keys;  ///< in addition to those of all lights
    bool has_position;              ///< otherwise the light has one direction everywhere
    bool has_direction;             ///< otherwise the light shines equally to all sides
    int shading;                    ///< VXL_LIGHT_* of kernels/shared/scene.h
    /// Sets the type's own parameters, and refuses contradictory ones.
    void (*place)(const LightParameters& parameters, const Refuse& refuse, Light& light);
    /// The part of the intensity at an angle from `direction` with this cosine; null: all of it.
    double (*part_at)(const Light& light, double cosine) = nullptr;
    const LightArea* area = nullptr;  ///< null for a light that shines from one point or direction
};

/// The rows in the order of LightKind.
std::span<const LightType> light_types();
const LightType& type_of(const Light& light);

/// Sets all values of a light of a type except its name and its position in the scene's text.
void set_light(const LightType& type, const LightParameters& parameters, const Refuse& refuse,
               Light& light);

}  // namespace voxelume
