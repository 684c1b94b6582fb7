// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/solid/solid_bounds.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxGridSize = 1 << 22;

SolidBounds everything() {
    return {glm::dvec3(-kInfinity), glm::dvec3(kInfinity)};
}

SolidBounds common_part(const SolidBounds& a, const SolidBounds& b) {
    return {glm::max(a.min, b.min), glm::min(a.max, b.max)};
}

SolidBounds hull(const SolidBounds& a, const SolidBounds& b) {
    if (a.is_empty()) return b;
    if (b.is_empty()) return a;
    return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

/// The distance from a shape's centre to its end along a frame axis, the one whose row of the map
/// is `row`.
double reach(const Solid& shape, const glm::dvec3& row) {
    const double across = std::hypot(row.x, row.z), along = std::abs(row.y) * shape.height / 2;
    const double length = std::hypot(row.x, row.y, row.z);
    switch (shape.kind) {
        case SolidKind::ellipsoid:
            return std::hypot(row.x * shape.radii.x, row.y * shape.radii.y, row.z * shape.radii.z);
        case SolidKind::box:
            return (std::abs(row.x) * shape.size.x + std::abs(row.y) * shape.size.y +
                    std::abs(row.z) * shape.size.z) /
                   2;
        case SolidKind::cylinder:
            return along + across * shape.radius;
        case SolidKind::torus:
            return across * shape.radius + length * shape.tube;
        case SolidKind::capsule:
            return along + length * shape.radius;
        case SolidKind::slab:
            return across > 0 ? kInfinity : std::abs(row.y) * shape.thickness / 2;
        default:
            return length * shape.radius;
    }
}

SolidBounds shape_bounds(const Solid& shape, const glm::dmat4& frame_from_shape) {
    const glm::dvec3 centre(frame_from_shape[3]);
    SolidBounds box{centre, centre};
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 row(frame_from_shape[0][axis], frame_from_shape[1][axis],
                             frame_from_shape[2][axis]);
        if (shape.kind == SolidKind::cone) {  // the hull of its two discs
            const double across = std::hypot(row.x, row.z), up = row.y * shape.height / 2;
            box.min[axis] += std::min(-up - across * shape.radius, up - across * shape.top_radius);
            box.max[axis] += std::max(-up + across * shape.radius, up + across * shape.top_radius);
        } else {
            const double distance = reach(shape, row);
            box.min[axis] -= distance;
            box.max[axis] += distance;
        }
    }
    return box;
}

SolidBounds tree_bounds(const Solid& solid, const glm::dmat4& frame_from_parent) {
    const glm::dmat4 frame_from_solid = frame_from_parent * solid.parent_from_solid;
    if (!is_combination(solid.kind)) return shape_bounds(solid, frame_from_solid);
    SolidBounds box = tree_bounds(solid.parts.front(), frame_from_solid);
    if (solid.kind == SolidKind::difference_of) return box;
    for (size_t i = 1; i < solid.parts.size(); ++i) {
        const SolidBounds part = tree_bounds(solid.parts[i], frame_from_solid);
        box = solid.kind == SolidKind::union_of ? hull(box, part) : common_part(box, part);
    }
    return box;
}

}  // namespace

bool SolidBounds::is_empty() const {
    return !(min.x <= max.x && min.y <= max.y && min.z <= max.z);
}

SolidBounds bounds(const Solid& solid, const glm::dmat4& frame_from_solid,
                   const std::optional<SolidBounds>& clip) {
    const SolidBounds box =
        common_part(tree_bounds(solid, frame_from_solid), clip.value_or(everything()));
    for (int axis = 0; axis < 3 && !box.is_empty(); ++axis)
        if (!std::isfinite(box.min[axis]) || !std::isfinite(box.max[axis]))
            throw Error(ErrorKind::scene,
                        "a solid has no end along {}: give the world bounds, or intersect the slab "
                        "with a finite solid",
                        "xyz"[axis]);
    return box;
}

bool reaches_past(const Solid& solid, const glm::dmat4& frame_from_solid, const SolidBounds& box) {
    const SolidBounds whole = tree_bounds(solid, frame_from_solid);
    return glm::any(glm::lessThan(whole.min, box.min)) ||
           glm::any(glm::greaterThan(whole.max, box.max));
}

GridFrame frame_around(const Solid& solid, const glm::dmat4& frame_from_solid,
                       const glm::dvec3& voxel_edge, int margin,
                       const std::optional<SolidBounds>& clip) {
    const SolidBounds box = bounds(solid, frame_from_solid, clip);
    if (box.is_empty())
        throw Error(ErrorKind::scene,
                    "a solid is empty inside the world's bounds: move it or remove it");
    const SolidBounds whole = clip.value_or(everything());
    GridFrame frame;
    frame.voxel_edge = voxel_edge;
    for (int axis = 0; axis < 3; ++axis) {
        const double edge = voxel_edge[axis], room = margin * edge;
        const double first = std::floor(std::max(box.min[axis] - room, whole.min[axis]) / edge);
        const double last = std::ceil(std::min(box.max[axis] + room, whole.max[axis]) / edge);
        const double count = std::max(1.0, last - first);
        if (!(count <= kMaxGridSize))
            throw Error(ErrorKind::limit,
                        "a solid is {:.3g} voxels long along {}, at most {} are possible: use "
                        "voxels larger than {:.3g} m",
                        count, "xyz"[axis], kMaxGridSize, edge * count / kMaxGridSize);
        frame.origin[axis] = first * edge;
        frame.size[axis] = static_cast<int>(count);
    }
    return frame;
}

}  // namespace voxelume
