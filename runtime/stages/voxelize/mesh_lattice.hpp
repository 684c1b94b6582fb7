// SPDX-License-Identifier: Apache-2.0
// A mesh on the lattice of 1/4096 voxel: the exact input of voxelization.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/grid/grid_frame.hpp"

namespace voxelume {

inline constexpr int kLatticePerVoxel = 4096;

/// The maximum distance of a mesh from its grid and the maximum size of a grid, in voxels. It keeps
/// every predicate of kernels/lib/voxelize/lattice.h within its bits.
inline constexpr int kLatticeReach = 16384;

/// Vertices and triangles as kernels read them.
struct MeshLattice {
    std::vector<glm::ivec3> vertices;   ///< lattice units from the frame's origin
    std::vector<glm::uvec3> triangles;  ///< the mesh's in order, then those that close its holes
    size_t surface_triangles = 0;       ///< number of the mesh's own triangles
};

/// Rounds the mesh's vertices once, ties to even, to the lattice of `frame`.
///
/// `frame_from_mesh` maps the mesh's space to the space of the frame, in double. Throws
/// Error::input for a mesh without triangles, an index out of range and a vertex that is not
/// finite, Error::limit for one that is more than kLatticeReach voxels from the frame's origin.
MeshLattice snap_to_lattice(const Mesh& mesh, const glm::dmat4& frame_from_mesh,
                            const GridFrame& frame);

/// A vertex in voxels of the frame, not rounded.
glm::dvec3 to_voxels(const glm::vec3& position, const glm::dmat4& frame_from_mesh,
                     const GridFrame& frame);

/// Closes the mesh: appends triangles that fan from a point near each open outline's middle to its
/// edges. The whole then has no boundary and integer winding numbers. A closed mesh gets no
/// triangles.
///
/// Vertices at one lattice point count as one, and opposite edges cancel, so neither seams nor
/// doubled sheets count as holes.
void cap_open_outlines(MeshLattice& mesh);

}  // namespace voxelume
