// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/solid/flush_faces.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <vector>

#include "runtime/geometry/solid/solid_bounds.hpp"

namespace voxelume {
namespace {

/// The largest differences, relative to sizes, that come from decimal numbers in scenes and from
/// maps in doubles.
constexpr double kRounding = 1e-9;

constexpr double kFar = 1e9;  // metres

/// The points x on it have dot(normal, x) = offset; the normal has unit length and looks outwards.
struct FacePlane {
    glm::dvec3 normal;
    double offset;
};

/// Half of the distance between a shape's planes along each axis; 0 along axes without planes.
glm::dvec3 half_edges(const Solid& shape) {
    switch (shape.kind) {
        case SolidKind::box:
            return shape.size / 2.0;
        case SolidKind::slab:
            return {0, shape.thickness / 2, 0};
        case SolidKind::cylinder:
        case SolidKind::cone:
            return {0, shape.height / 2, 0};
        default:
            return glm::dvec3(0);
    }
}

void add_planes(const Solid& solid, const glm::dmat4& map_of_parent,
                std::vector<FacePlane>& planes) {
    const glm::dmat4 map = map_of_parent * solid.parent_from_solid;
    for (const Solid& part : solid.parts) add_planes(part, map, planes);
    if (is_combination(solid.kind)) return;
    const glm::dvec3 half = half_edges(solid);
    const glm::dmat3 normals = glm::transpose(glm::inverse(glm::dmat3(map)));
    for (int axis = 0; axis < 3; ++axis) {
        if (half[axis] == 0) continue;
        const glm::dvec3 normal = glm::normalize(normals[axis]);
        const double middle = glm::dot(normal, glm::dvec3(map[3])),
                     reach = half[axis] / glm::length(normals[axis]);
        planes.push_back({normal, middle + reach});
        planes.push_back({-normal, reach - middle});
    }
}

std::vector<FacePlane> planes_of(const Solid& solid) {
    std::vector<FacePlane> planes;
    add_planes(solid, glm::dmat4(1), planes);
    return planes;
}

}  // namespace

bool have_flush_faces(const Solid& a, const Solid& b) {
    const std::vector<FacePlane> of_a = planes_of(a), of_b = planes_of(b);
    if (of_a.empty() || of_b.empty()) return false;
    const SolidBounds all{glm::dvec3(-kFar), glm::dvec3(kFar)};
    const SolidBounds box_a = bounds(a, glm::dmat4(1), all), box_b = bounds(b, glm::dmat4(1), all);
    const double slack =
        kRounding * (glm::length(box_a.max - box_a.min) + glm::length(box_b.max - box_b.min));
    if (glm::any(glm::greaterThan(box_a.min, box_b.max + slack)) ||
        glm::any(glm::greaterThan(box_b.min, box_a.max + slack)))
        return false;
    const auto continues = [&](const FacePlane& p, const FacePlane& q) {
        return glm::dot(p.normal, q.normal) > 1 - kRounding &&
               std::abs(p.offset - q.offset) <= slack;
    };
    return std::ranges::any_of(of_a, [&](const FacePlane& p) {
        return std::ranges::any_of(of_b, [&](const FacePlane& q) { return continues(p, q); });
    });
}

}  // namespace voxelume
