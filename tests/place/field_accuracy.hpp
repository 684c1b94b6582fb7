// SPDX-License-Identifier: Apache-2.0
// Distance fields for tests, and their accuracy in the world.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "tests/place/placing.hpp"

namespace voxelume {

/// The distance from the surface, in voxels, within which objects' fields are right, as voxelizers
/// make them.
inline constexpr double kBand = 2.8;

inline int16_t banded(double voxels) {
    return std::abs(voxels) <= kBand ? stored_distance(voxels)
                                     : int16_t(voxels < 0 ? -32767 : 32767);
}

/// A sphere about the origin of its space, in voxels of `edge`.
inline HostBricks sphere_bricks(double radius, double edge) {
    const int half = int(std::ceil(radius / edge)) + 5;
    const GridFrame frame = frame_at(glm::dvec3(-half * edge), glm::dvec3(edge),
                                     {2 * half, 2 * half + 1, 2 * half + 2});
    return distance_bricks(frame, [&](const glm::ivec3& n) {
        return banded((glm::length(glm::dvec3(n) * edge + frame.origin) - radius) / edge);
    });
}

/// Calls visit(node, distance in world voxels) for the nodes of the world's voxels.
template <class Visit>
void for_each_node(const BrickGrid& world, const Visit& visit) {
    const ReadBricks bricks(world);
    for (glm::ivec3 n{0}; n.z <= world.frame.size.z; ++n.z)
        for (n.y = 0; n.y <= world.frame.size.y; ++n.y)
            for (n.x = 0; n.x <= world.frame.size.x; ++n.x)
                visit(n, bricks.distance_at(n) / 8192.0);
}

struct Accuracy {
    double near = 0, band = 0;  // maximum errors within 1.75 and `reach` voxels of the surface
    int wrong_sides = 0;
};

inline Accuracy accuracy_of(const BrickGrid& world, const std::function<double(glm::dvec3)>& metres,
                            double reach = 2.7) {
    Accuracy accuracy;
    const GridFrame& frame = world.frame;
    for_each_node(world, [&](const glm::ivec3& n, double placed) {
        const double truth = metres(frame.origin + frame.voxel_edge * glm::dvec3(n)) /
                             std::min({frame.voxel_edge.x, frame.voxel_edge.y, frame.voxel_edge.z});
        const double error = std::abs(placed - truth);
        if (std::abs(truth) <= 1.75) accuracy.near = std::max(accuracy.near, error);
        if (std::abs(truth) <= reach) accuracy.band = std::max(accuracy.band, error);
        accuracy.wrong_sides += std::abs(truth) > 0.01 && (placed < 0) != (truth < 0);
    });
    return accuracy;
}

}  // namespace voxelume
