// SPDX-License-Identifier: Apache-2.0
// Points and lines -> triangles without area. Cubes hold all that a triangle meets, so they show
// points and lines, too; rays never hit such triangles.
#pragma once

#include <cstdint>

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

inline glm::uvec3 point_triangle(uint32_t vertex) {
    return glm::uvec3(vertex);
}

inline glm::uvec3 line_triangle(uint32_t from, uint32_t to) {
    return {from, to, to};
}

/// Makes each vertex a point.
void show_vertices(Mesh& mesh);

/// The numbers of a mesh's points and lines, each of which is a triangle.
struct PointCounts {
    uint64_t points = 0, lines = 0;
};
PointCounts count_points(const Mesh& mesh);

/// True for a mesh without a triangle that has three corners.
bool has_points_alone(const Mesh& mesh);

/// The edge of voxels in which a scan's points look like a surface. It is `finest` or larger by
/// powers of two, until voxels have kPointsPerVoxel distinct points on average or the longest side
/// has fewer than 2 kFewestVoxels voxels. Lines are whole in voxels of any size; twice the finest
/// keeps them from being thinner than a pixel. Meshes with real triangles have `finest`.
double voxel_edge_of_points(const Mesh& mesh, double finest);

/// The mean number of points per voxel. A surface sampled at random then leaves e^-3 of its voxels,
/// one in twenty, without a point.
inline constexpr double kPointsPerVoxel = 3;
inline constexpr double kFewestVoxels = 32;

}  // namespace voxelume
