// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/solid/solid_inside.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "runtime/geometry/solid/shape_map.hpp"

namespace voxelume {
namespace {

bool is_inside_shape(const Solid& shape, const glm::dvec3& p) {
    const double across = std::hypot(p.x, p.z), up = std::abs(p.y);
    switch (shape.kind) {
        case SolidKind::sphere:
            return glm::length(p) < shape.radius;
        case SolidKind::ellipsoid:
            return glm::length(p / shape.radii) < 1;
        case SolidKind::box:
            return glm::all(glm::lessThan(glm::abs(p), shape.size / 2.0));
        case SolidKind::cylinder:
            return across < shape.radius && up < shape.height / 2;
        case SolidKind::cone:
            return up < shape.height / 2 &&
                   across < glm::mix(shape.radius, shape.top_radius, p.y / shape.height + 0.5);
        case SolidKind::torus:
            return std::hypot(across - shape.radius, p.y) < shape.tube;
        case SolidKind::capsule:
            return std::hypot(across, std::max(up - shape.height / 2, 0.0)) < shape.radius;
        case SolidKind::slab:
            return up < shape.thickness / 2;
        default:
            return false;
    }
}

/// The shortest width of a shape without planes all around, in its own space.
double width_of(const Solid& shape) {
    switch (shape.kind) {
        case SolidKind::ellipsoid:
            return 2 * std::min({shape.radii.x, shape.radii.y, shape.radii.z});
        case SolidKind::cylinder:
            return std::min(2 * shape.radius, shape.height);
        case SolidKind::cone:
            return std::min(2 * std::max(shape.radius, shape.top_radius), shape.height);
        case SolidKind::torus:
            return 2 * shape.tube;
        default:
            return 2 * shape.radius;
    }
}

}  // namespace

bool is_inside(const Solid& solid, const glm::dvec3& point) {
    const glm::dvec3 p(glm::inverse(solid.parent_from_solid) * glm::dvec4(point, 1));
    if (!is_combination(solid.kind)) return is_inside_shape(solid, p);
    const auto holds = [&](const Solid& part) { return is_inside(part, p); };
    if (solid.kind == SolidKind::union_of) return std::ranges::any_of(solid.parts, holds);
    if (solid.kind == SolidKind::intersection_of) return std::ranges::all_of(solid.parts, holds);
    return holds(solid.parts.front()) &&
           std::none_of(solid.parts.begin() + 1, solid.parts.end(), holds);
}

double thickness(const Solid& solid, const glm::dmat3& map) {
    const glm::dmat3 own = map * glm::dmat3(solid.parent_from_solid);
    if (solid.kind == SolidKind::difference_of) return thickness(solid.parts.front(), own);
    if (is_combination(solid.kind)) {
        double least = thickness(solid.parts.front(), own);
        for (const Solid& part : solid.parts) least = std::min(least, thickness(part, own));
        return least;
    }
    const bool has_planes = solid.kind == SolidKind::box || solid.kind == SolidKind::slab;
    if (!has_planes) return width_of(solid) * smallest_singular_value(own);
    const glm::dmat3 normals = glm::transpose(glm::inverse(own));  // columns: gradients of x, y, z
    if (solid.kind == SolidKind::slab) return solid.thickness / glm::length(normals[1]);
    return std::min({solid.size.x / glm::length(normals[0]), solid.size.y / glm::length(normals[1]),
                     solid.size.z / glm::length(normals[2])});
}

}  // namespace voxelume
