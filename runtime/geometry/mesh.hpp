// SPDX-License-Identifier: Apache-2.0
// A triangle mesh as read from a file: the geometry that `voxelize` turns into an object.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace voxelume {

/// An entry of Mesh::triangle_normals for a corner without a normal.
inline constexpr uint32_t kNoNormal = 0xFFFFFFFFu;

/// Triangles with optional colours and normals at the vertices and named groups of faces.
///
/// Every index is below `positions.size()`, or that of normals below `normals.size()`, and every
/// coordinate is finite: readers refuse other meshes.
struct Mesh {
    std::vector<glm::vec3> positions;  ///< object space, metres
    std::vector<glm::uvec3>
        triangles;  ///< indices into `positions`, counter-clockwise from outside
    std::vector<glm::vec3>
        vertex_colors;  ///< linear Rec. 709, one per position; empty when there are none
    std::vector<glm::vec3> normals;  ///< of any length; those of length 0 say nothing
    /// Indices into `normals`, one per triangle, of its corners. Empty: normals are one per
    /// position, or none.
    std::vector<glm::uvec3> triangle_normals;
    std::vector<uint32_t>
        triangle_group;  ///< index into `group_names`, one per triangle; empty: all group 0
    std::vector<std::string>
        group_names;  ///< material groups in order of appearance; empty: one unnamed group
    // Files that the mesh's file names, and that aren't read.
    std::string material_library = {};  ///< of OBJ's first mtllib
    std::string texture = {};           ///< of PLY's first comment TextureFile
};

}  // namespace voxelume
