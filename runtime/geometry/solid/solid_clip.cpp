// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/solid/solid_clip.hpp"

#include <glm/ext/matrix_transform.hpp>
#include <glm/vector_relational.hpp>

#include "runtime/geometry/solid/solid_bounds.hpp"

namespace voxelume {
namespace {

Solid box_solid(const SolidBounds& box) {
    Solid solid;
    solid.kind = SolidKind::box;
    solid.size = box.max - box.min;
    solid.parent_from_solid = glm::translate(glm::dmat4(1), 0.5 * (box.min + box.max));
    return solid;
}

bool leads_along_one_axis(const glm::dvec3& v) {
    return (v.x != 0) + (v.y != 0) + (v.z != 0) == 1;
}

/// True if the solid is a box whose edges lie along the axes, or a slab as such a box without end.
bool is_upright_box(const Solid& solid, const glm::dmat4& frame_from_solid) {
    if (solid.kind != SolidKind::box && solid.kind != SolidKind::slab) return false;
    const glm::dmat4 map = frame_from_solid * solid.parent_from_solid;
    for (int axis = 0; axis < 3; ++axis)
        if (!leads_along_one_axis(glm::dvec3(map[axis]))) return false;
    return true;
}

bool has_inside(const SolidBounds& box) {
    return glm::all(glm::lessThan(box.min, box.max));
}

}  // namespace

Solid clipped_solid(const Solid& solid, const glm::dmat4& frame_from_solid,
                    const GridFrame& frame) {
    const SolidBounds grid = {frame.origin,
                              frame.origin + glm::dvec3(frame.size) * frame.voxel_edge};
    Solid placed = solid;
    placed.parent_from_solid = frame_from_solid * solid.parent_from_solid;
    if (!reaches_past(solid, frame_from_solid, grid)) return placed;
    const SolidBounds part = bounds(solid, frame_from_solid, grid);
    if (is_upright_box(solid, frame_from_solid) && has_inside(part)) return box_solid(part);
    Solid clipped;
    clipped.kind = SolidKind::intersection_of;
    clipped.parts = {placed, box_solid(grid)};
    return clipped;
}

}  // namespace voxelume
