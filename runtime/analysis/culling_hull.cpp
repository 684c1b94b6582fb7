// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/culling_hull.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "runtime/analysis/object_boxes.hpp"
#include "runtime/scene/parts/light.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

constexpr int kSteps = 64;  // a box counts as met after this many steps

glm::dvec3 in_voxels(const glm::dvec3& point, const GridFrame& world) {
    return (point - world.origin) / world.voxel_edge;
}

void add_corners(const glm::dvec3& low, const glm::dvec3& high, Hull& hull) {
    for (int i = 0; i < 8; ++i)
        hull.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
}

/// The minimum and maximum depth of the world along Z_E, metres.
glm::dvec2 depths_of(const GridFrame& world, const Observer& observer) {
    Hull corners;
    add_corners(world.origin, world.origin + world.voxel_edge * glm::dvec3(world.size), corners);
    glm::dvec2 depths(INFINITY, -INFINITY);
    for (const glm::dvec3& corner : corners) {
        const double depth = glm::dot(corner - observer.position, observer.world_from_observer[2]);
        depths = {std::min(depths.x, depth), std::max(depths.y, depth)};
    }
    return depths;
}

/// The box around everything nearer than the display's far surface, cut to the world.
Hull hull_of_ball(const Observer& observer, const GridFrame& world) {
    const glm::dvec3 size(world.size), far(observer.display.far);
    Hull hull;
    add_corners(glm::clamp(in_voxels(observer.position - far, world), glm::dvec3(0), size),
                glm::clamp(in_voxels(observer.position + far, world), glm::dvec3(0), size), hull);
    return hull;
}

/// The distance from a light's position to the farthest point that it shines from, metres.
double radius_of(const Light& light) {
    const LightArea* area = type_of(light).area;
    return area == nullptr ? 0 : area->radius(light);
}

const glm::dvec3& farthest(const Hull& hull, const glm::dvec3& direction) {
    return *std::ranges::max_element(
        hull, {}, [&](const glm::dvec3& point) { return glm::dot(point, direction); });
}

}  // namespace

Hull hull_of_sight_rays(const Observer& observer, const GridFrame& world) {
    const Display& display = observer.display;
    const DisplayShapeRow& shape = shape_row(display);
    const std::optional<FlatSides> sides = shape.flat_sides(display);
    if (!sides) return hull_of_ball(observer, world);
    const glm::dvec2 half = sides->half;
    const bool parallel = shape.projection == SightProjection::parallel;
    const glm::dvec2 depths = depths_of(world, observer);
    const double near = std::max(sides->near, depths.x);
    const double far = std::max(near, std::min(display.far, depths.y));
    Hull hull;
    for (const double depth : {near, far})
        for (int corner = 0; corner < 4; ++corner) {
            const glm::dvec2 side(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y);
            const glm::dvec3 point(side * (parallel ? 1.0 : depth), depth);
            hull.push_back(
                in_voxels(observer.position + observer.world_from_observer * point, world));
        }
    return hull;
}

void add_shadow_rays(const Scene& scene, const std::vector<VoxelBox>& emissive_objects,
                     const GridFrame& world, Hull& hull) {
    const Hull seen = hull;
    VoxelBox lights{glm::dvec3(INFINITY),
                    glm::dvec3(-INFINITY)};  // box around all lights that have a position
    const auto include = [&](const glm::dvec3& low, const glm::dvec3& high) {
        lights = {glm::min(lights.low, low), glm::max(lights.high, high)};
    };
    for (const Light& light : scene.lights) {
        if (!shines(light)) continue;
        if (type_of(light).has_position) {
            const glm::dvec3 radius(radius_of(light));
            include(in_voxels(light.position - radius, world),
                    in_voxels(light.position + radius, world));
            continue;
        }
        // No path through the world is longer than its diagonal.
        const glm::dvec3 towards = glm::normalize(-light.direction / world.voxel_edge);
        for (const glm::dvec3& point : seen)
            hull.push_back(point + towards * glm::length(glm::dvec3(world.size)));
    }
    for (const VoxelBox& emissive_object : emissive_objects)
        include(emissive_object.low, emissive_object.high);
    if (!is_empty(lights)) add_corners(lights.low, lights.high, hull);
}

// After Frank and Wolfe 1956: `way` approaches the shortest of the vectors from the hull to the
// box. Its direction separates them if any direction does. The result depends on the plane that is
// found, not on how it was found.
bool are_apart(const Hull& hull, const VoxelBox& box, double gap) {
    glm::dvec3 way = (box.low + box.high) / 2.0 - hull[0];
    for (int step = 0; step < kSteps; ++step) {
        const double length = glm::length(way);
        if (!(length > gap)) return false;
        const glm::dvec3 normal = way / length;
        const glm::dvec3 corner =
            glm::mix(box.high, box.low, glm::greaterThan(normal, glm::dvec3(0)));
        const glm::dvec3 between = corner - farthest(hull, normal);
        if (glm::dot(between, normal) > gap) return true;
        const glm::dvec3 turn = between - way;
        const double share = -glm::dot(way, turn) / glm::dot(turn, turn);
        if (!(share > 0)) return false;
        way += std::min(share, 1.0) * turn;
    }
    return false;
}

}  // namespace voxelume
