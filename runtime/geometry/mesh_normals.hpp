// SPDX-License-Identifier: Apache-2.0
// mesh -> the normals of its triangles' corners, by which light falls on it.
#pragma once

#include <glm/mat3x3.hpp>

#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/scene/parts/shading.hpp"

namespace voxelume {

/// The vector of length 1 along v; 0 where v has no direction.
glm::dvec3 unit_or_zero(const glm::dvec3& v);

/// Three unit vectors for each triangle, in the mesh's space; zero vectors for a corner without a
/// normal. Empty if the mesh is shaded flat.
///
/// Where `shading` asks for normals and the mesh has none, a corner's is the mean of the normals of
/// the faces around it that meet the corner's own at `crease_angle` at most, weighted by their
/// angles at the vertex (Thürmer & Wüthrich 1998). Vertices at one position are one vertex.
std::vector<glm::vec3> corner_normals(const Mesh& mesh, const Shading& shading);

/// The normals packed as in shared/normal.h, each multiplied by `map` first: the inverse transpose
/// of the map from the mesh's space to voxels. A triangle with a corner without a normal has none.
/// If the mean of a triangle's normals points to the back of its face, they are turned over: files
/// disagree about the side. A map that mirrors expects a mesh that is turned over: its faces look
/// outwards in voxels.
std::vector<uint32_t> packed_normals(const Mesh& mesh, const std::vector<glm::vec3>& normals,
                                     const glm::dmat3& map);

/// A vector of any length above 0 as its code in shared/normal.h.
uint32_t packed_normal(const glm::dvec3& normal);

/// The unit vector of a code.
glm::dvec3 unpacked_normal(uint32_t code);

}  // namespace voxelume
