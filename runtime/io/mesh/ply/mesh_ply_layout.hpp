// SPDX-License-Identifier: Apache-2.0
// The meaning of the properties of a PLY file's vertices and faces, classified before rows are
// read.
#pragma once

#include "runtime/io/mesh/ply/mesh_ply_header.hpp"

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace voxelume {

/// The purpose of a property. All but the last are also indices into a row of numbers.
enum PlyRole : size_t {
    kPlyX,
    kPlyY,
    kPlyZ,
    kPlyNx,
    kPlyNy,
    kPlyNz,
    kPlyRed,
    kPlyGreen,
    kPlyBlue,
    kPlyAlpha,
    kPlyU,
    kPlyV,
    kPlyRoles,
    kPlySkipped = kPlyRoles
};

/// The numbers of a row, by their roles.
using PlyRow = std::array<double, kPlyRoles>;

struct PlyLayout {
    std::vector<PlyRole> roles;  ///< one per property
    PlyRow scale{};              ///< the value that stands for 1
    bool has_color = false;
    bool has_alpha = false;
    bool has_normal = false;
    bool has_uv = false;
};

inline bool is_ply_normal(PlyRole role) {
    return role >= kPlyNx && role <= kPlyNz;
}

inline bool is_ply_color(PlyRole role) {
    return role >= kPlyRed && role <= kPlyAlpha;
}

/// The layout of vertices. Throws Error::input where they have no position, a property twice or
/// colours of another type than uchar, ushort, float and double; alpha of another one is skipped.
PlyLayout ply_vertex_layout(const MeshSource& source, const PlyElement& element);

/// The layout of faces: only the colour and its alpha count. Colours of other types are skipped.
PlyLayout ply_face_layout(const PlyElement& element);

/// The linear colour of a row. If it is out of range, the first component is negative, and the
/// others are the value and its maximum.
glm::dvec3 ply_color(const PlyRow& row, const PlyLayout& layout);

}  // namespace voxelume
