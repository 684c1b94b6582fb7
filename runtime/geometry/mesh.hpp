// SPDX-License-Identifier: Apache-2.0
// A triangle mesh as read from a file: the geometry that `voxelize` turns into an object.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/geometry/texture.hpp"

namespace voxelume {

/// An entry of Mesh::triangle_normals for a corner without a normal.
inline constexpr uint32_t kNoNormal = 0xFFFFFFFFu;

/// An entry of Mesh::triangle_uvs for a corner without texture coordinates.
inline constexpr uint32_t kNoUv = 0xFFFFFFFFu;

/// Triangles with optional colours and normals at their corners and named groups of faces.
///
/// Every index is below the size of what it counts in, and every coordinate is finite: readers
/// refuse other meshes.
struct Mesh {
    std::vector<glm::vec3> positions;  ///< object space, metres
    std::vector<glm::uvec3>
        triangles;  ///< indices into `positions`, counter-clockwise from outside
    std::vector<glm::vec3> vertex_colors;  ///< linear Rec. 709; empty when there are none
    /// Indices into `vertex_colors`, one per triangle, of its corners. Empty: colours are one per
    /// position, or none.
    std::vector<glm::uvec3> triangle_colors;
    std::vector<glm::vec3> normals;  ///< of any length; those of length 0 say nothing
    /// Indices into `normals`, one per triangle, of its corners. Empty: normals are one per
    /// position, or none.
    std::vector<glm::uvec3> triangle_normals;
    std::vector<uint32_t>
        triangle_group;  ///< index into `group_names`, one per triangle; empty: all group 0
    std::vector<std::string>
        group_names;  ///< material groups in order of appearance; empty: one unnamed group
    /// Places on a texture: u to the right and v down from its upper left corner, whose whole size
    /// is 1. One per position unless `triangle_uvs` has indices, kNoUv for a corner without one.
    std::vector<glm::vec2> uvs;
    std::vector<glm::uvec3> triangle_uvs;
    std::vector<Texture> textures;
    /// Indices into `textures`, one per group of faces, kNoTexture for a group without one. Empty:
    /// there are no textures.
    std::vector<uint32_t> group_textures;
    std::vector<std::string> material_libraries = {};  ///< names of OBJ's mtllib, each once
    /// Names of groups whose materials none of the libraries has, and sentences on libraries that
    /// can't be read.
    std::vector<std::string> missing_materials = {}, library_faults = {};
    std::string texture = {};  ///< name in PLY's first comment TextureFile
    /// Sentences, each without its full stop, on what isn't shown of the file.
    std::vector<std::string> notes = {};
    /// Sentences, for descriptions alone, on what was assumed where the file doesn't say it.
    std::vector<std::string> assumptions = {};
};

}  // namespace voxelume
