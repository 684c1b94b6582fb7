// SPDX-License-Identifier: Apache-2.0
// Analytic solids and their unions, intersections and differences, as values.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/scene/parts/value_row.hpp"

namespace voxelume {

enum class SolidKind : uint8_t {
    sphere,
    ellipsoid,
    box,
    cylinder,
    cone,
    torus,
    capsule,
    slab,
    union_of,         ///< union of all parts
    intersection_of,  ///< intersection of all parts
    difference_of,    ///< the first part without all others
};

/// One node of a tree of solids. All lengths are in metres in the node's own space, whose origin is
/// the centre of the shape and whose Y axis is the axis of cylinder, cone, torus and capsule.
///
/// Guaranteed by `read_scene`: finite parameters in the stated ranges, one or more parts in a
/// combination and none in a shape, invertible maps, at most `kMaxSolidDepth` levels and
/// `kMaxSolidShapes` shapes in a tree.
struct Solid {
    SolidKind kind = SolidKind::sphere;

    double radius =
        0;  ///< sphere, cylinder, capsule; cone: at y = -height/2; torus: of the ring. > 0
    double top_radius = 0;  ///< cone: at y = +height/2; 0 for a pointed cone. >= 0
    double tube = 0;        ///< torus: radius of the tube. > 0, at most `radius`
    double height =
        0;  ///< cylinder, cone: whole height; capsule: of the part between the caps. > 0
    double thickness = 0;  ///< slab: |y| <= thickness/2, without end in x and z. > 0
    glm::dvec3 radii{0};   ///< ellipsoid: half axes. > 0
    glm::dvec3 size{0};    ///< box: whole edges. > 0

    glm::dmat4 parent_from_solid{1};  ///< affine; identity at the root
    std::vector<Solid> parts;         ///< parts of a combination; empty for a shape

    bool operator==(const Solid&) const = default;
};

inline constexpr int kMaxSolidDepth = 16;
inline constexpr int kMaxSolidShapes = 256;

constexpr bool is_combination(SolidKind kind) {
    return kind >= SolidKind::union_of;
}

/// True if the tree is infinite as far as its kinds tell: a slab, a union with an infinite part, an
/// intersection of infinite parts only, a difference from an infinite part.
bool is_infinite(const Solid& solid);

/// A shape, or a way to combine parts.
struct SolidType {
    SolidKind kind;
    std::string_view name;  ///< in scene files
    std::span<const KindKey> keys;
};

/// The rows in the order of SolidKind.
std::span<const SolidType> solid_types();
std::span<const ValueRow<Solid>> solid_rows();

/// Refuses contradictory lengths of one shape.
void check_solid(const Solid& solid, const Refuse& refuse);

}  // namespace voxelume
