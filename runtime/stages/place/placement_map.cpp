// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/place/placement_map.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "runtime/base/error.hpp"
#include "runtime/scene/parts/scene_affine.hpp"

namespace voxelume {
namespace {

constexpr double kWorstCondition = 1e5;
constexpr int kOffsetBits = 24;
constexpr int kMaxFractionBits = 40;
constexpr int kSumBits = 61;

double shortest(const glm::dvec3& edges) {
    return std::min({edges.x, edges.y, edges.z});
}

/// The largest number of fraction bits for which sums over all the world's voxels can't overflow.
int fraction_bits(const glm::dmat3& linear, const glm::dvec3& offset, const GridFrame& world,
                  uint32_t object) {
    const glm::dvec3 size = glm::dvec3(world.bricks() * kBrickSize + 2 * kBrickSize);
    double largest = 1;
    for (int axis = 0; axis < 3; ++axis) {
        double sum = std::abs(offset[axis]);
        for (int column = 0; column < 3; ++column)
            sum += std::abs(linear[column][axis]) * size[column];
        largest = std::max(largest, sum);
    }
    const int bits = std::min(kMaxFractionBits, kSumBits - std::ilogb(largest) - 2);
    if (bits < kOffsetBits)
        throw Error(ErrorKind::scene,
                    "object {}: it lies {:.3g} of its voxels from the world's origin, which is too "
                    "far or too small to place: use larger voxels or move it",
                    object, largest);
    return bits;
}

/// The reach along each object axis. `supercover` closes the gaps that steps longer than a voxel
/// would leave; `thin` covers half of every step.
glm::dvec3 reach_of(const glm::dmat3& linear, Reach reach) {
    if (reach == Reach::none) return glm::dvec3(1);
    glm::dvec3 longest(0);
    bool on_lattice = true;
    for (int column = 0; column < 3; ++column)
        for (int axis = 0; axis < 3; ++axis) {
            const double step = std::abs(linear[column][axis]);
            longest[axis] = std::max(longest[axis], step);
            on_lattice = on_lattice && (step == 0 || step == 1);
        }
    if (reach == Reach::thin && !on_lattice) return longest * 0.5;
    return (glm::max(longest, glm::dvec3(1)) - 1.0) * 0.5;
}

/// The steps from one voxel of the world to the next, in voxels of the object.
glm::dmat3 steps_of(const GridFrame& object_frame, const GridFrame& world_frame,
                    const glm::dmat3& object_from_world) {
    glm::dmat3 linear;
    for (int column = 0; column < 3; ++column)
        linear[column] =
            object_from_world[column] * world_frame.voxel_edge[column] / object_frame.voxel_edge;
    return linear;
}

/// The world's first node, in voxels of the object.
glm::dvec3 first_node(const GridFrame& object_frame, const GridFrame& world_frame,
                      const glm::dmat4& world_from_object, const glm::dmat3& object_from_world) {
    const glm::dvec3 from_object = world_frame.origin - glm::dvec3(world_from_object[3]);
    return (object_from_world * from_object - object_frame.origin) / object_frame.voxel_edge;
}

}  // namespace

void check_invertible(const glm::dmat4& map, uint32_t object) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row)
            if (!std::isfinite(map[column][row]))
                throw Error(ErrorKind::scene,
                            "object {}: its placement is not finite: check its position, turn, "
                            "scale or matrix",
                            object);
    const Stretch stretch = stretch_of(glm::dmat3(map));
    if (stretch.min == 0)
        throw Error(ErrorKind::scene,
                    "object {}: its placement flattens it to nothing: give every axis a scale "
                    "other than 0",
                    object);
    if (stretch.max > kWorstCondition * stretch.min)
        throw Error(ErrorKind::scene,
                    "object {}: its placement stretches one direction {:.3g} times as much as "
                    "another, at most {:.0e} can be inverted exactly: make the model closer to its "
                    "final shape",
                    object, stretch.max / stretch.min, kWorstCondition);
}

double voxels_per_world_voxel(const GridFrame& object_frame, const GridFrame& world_frame,
                              const glm::dmat4& world_from_object) {
    const glm::dmat3 object_from_world = glm::inverse(glm::dmat3(world_from_object));
    return stretch_of(steps_of(object_frame, world_frame, object_from_world)).max;
}

bool maps_nodes_to_nodes(const GridFrame& object_frame, const GridFrame& world_frame,
                         const glm::dmat4& world_from_object) {
    const glm::dmat3 object_from_world = glm::inverse(glm::dmat3(world_from_object));
    const glm::dmat3 steps = steps_of(object_frame, world_frame, object_from_world);
    // True if fixed point rounds the number to whole voxels.
    const auto is_whole = [](double value, int bits) {
        return std::abs(value - std::round(value)) < std::ldexp(0.5, -bits);
    };
    for (int column = 0; column < 3; ++column) {
        double sum = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (!is_whole(steps[column][axis], kMaxFractionBits)) return false;
            sum += std::abs(std::round(steps[column][axis]));
        }
        if (sum != 1) return false;
    }
    const glm::dvec3 first =
        first_node(object_frame, world_frame, world_from_object, object_from_world);
    return is_whole(first.x, kOffsetBits) && is_whole(first.y, kOffsetBits) &&
           is_whole(first.z, kOffsetBits);
}

glm::dmat3 gradients_in_object(const GridFrame& object_frame, const GridFrame& world_frame,
                               const glm::dmat4& world_from_object) {
    const glm::dmat3 object_from_world = glm::inverse(glm::dmat3(world_from_object));
    const glm::dmat3 steps = steps_of(object_frame, world_frame, object_from_world);
    bool is_resampled = false;
    for (int column = 0; column < 3; ++column)
        for (int axis = 0; axis < 3; ++axis) {
            const double step = std::abs(steps[column][axis]);
            is_resampled |= std::min(step, std::abs(step - 1)) >= std::ldexp(0.5, -kOffsetBits);
        }
    return is_resampled ? glm::inverse(glm::transpose(steps)) : glm::dmat3(0);
}

PlacementMap placement_map(const GridFrame& object_frame, const GridFrame& world_frame,
                           const glm::dmat4& world_from_object, Reach reach, uint32_t object) {
    check_invertible(world_from_object, object);
    const glm::dmat3 object_from_world = glm::inverse(glm::dmat3(world_from_object));
    const glm::dmat3 linear = steps_of(object_frame, world_frame, object_from_world);
    const glm::dvec3 offset =
        first_node(object_frame, world_frame, world_from_object, object_from_world);

    PlacementMap map;
    map.fraction_bits = fraction_bits(linear, offset, world_frame, object);
    const auto fixed = [&](double value, int bits) {
        return std::llround(std::ldexp(value, bits)) << (map.fraction_bits - bits);
    };
    glm::dmat3 rounded;
    for (int axis = 0; axis < 3; ++axis) {
        for (int column = 0; column < 3; ++column) {
            const int64_t even = fixed(linear[column][axis], map.fraction_bits - 1);
            map.rows[4 * size_t(axis) + size_t(column)] = even;
            rounded[column][axis] = std::ldexp(double(even), -map.fraction_bits);
        }
        map.rows[4 * size_t(axis) + 3] = fixed(offset[axis], kOffsetBits);
    }
    const glm::dvec3 reaches = reach_of(rounded, reach);
    for (int axis = 0; axis < 3; ++axis) {
        const int64_t value = fixed(reaches[axis], map.fraction_bits);
        map.rows[12 + size_t(axis)] = value;
        map.has_reach = map.has_reach || value != 0;
    }
    map.distance_scale = stretch_of(glm::dmat3(world_from_object)).min *
                         shortest(object_frame.voxel_edge) / shortest(world_frame.voxel_edge);
    // Shifts by whole voxels and quarter turns between equal voxel edges leave every distance
    // unchanged.
    if (std::abs(map.distance_scale - 1) < 1e-12) map.distance_scale = 1;
    return map;
}

}  // namespace voxelume
