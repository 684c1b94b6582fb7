// SPDX-License-Identifier: Apache-2.0
// Mesh file -> Mesh: OBJ, PLY (ascii and binary of both endians) and STL (ascii and binary).
#pragma once

#include "runtime/geometry/mesh.hpp"

#include <filesystem>
#include <string>

namespace voxelume {

struct MeshSource;

/// Reads a triangle mesh.
///
/// The content decides the format where it is unmistakable (PLY by its first line, binary STL by
/// its size, ascii STL by "solid" ... "facet" or "endsolid"), whatever the file's name; otherwise
/// the extension decides. Vertex colours are taken as sRGB and become linear. Polygons are cut into
/// triangles. If a file has no faces, its points and lines become triangles without area; if it has
/// no points or lines either, all vertices do. Content without a member in struct Mesh (free-form
/// curves, lines of a file with faces) is skipped. Vertices that no face uses and triangles without
/// area are kept. Units are taken as metres.
///
/// Throws Error::input for a file that is missing, unreadable, damaged or without vertices, with a
/// sentence that starts with the file and the line or byte. Throws Error::limit for a file that is
/// too large.
Mesh read_mesh(const std::filesystem::path& path);

/// The bytes of the file, for parse_mesh. Throws Error::input and Error::limit as read_mesh does.
std::string read_mesh_bytes(const std::filesystem::path& path);

/// Parses a file's bytes in memory as read_mesh does. `name` opens the messages, and its extension
/// counts.
Mesh parse_mesh(const std::string& bytes, const std::filesystem::path& name);

/// Parses OBJ (Wavefront): `v`, `vn`, `vt`, `f`, `p`, `l`, `usemtl` and the name of `mtllib`. Other
/// statements of the format are skipped, and unknown words are refused. `v x y z r g b` has a
/// colour in [0, 1]; a vertex without a colour is white if others have one. Indices may be negative
/// but may not refer to later vertices. A corner has no normal if it is missing or not a number.
/// `g` and `o` don't make groups. A face of fewer than three corners is an error.
Mesh parse_obj(const MeshSource& source);

/// Parses PLY 1.0: the elements `vertex` and `face` with `vertex_indices` (or `vertex_index`) in
/// this order, with every scalar type. Other elements and properties are skipped. Colours are `red
/// green blue` (or `diffuse_red` ...) as uchar, ushort, or float in [0, 1], normals `nx ny nz`.
/// Vertices without faces are points. A face of fewer than three corners and data behind the last
/// element are errors. `comment TextureFile` names a texture.
Mesh parse_ply(const MeshSource& source);

/// Parses STL. Corners at the same position (-0 equals 0, no tolerance) become one vertex, so that
/// triangles are connected as in the other formats. Vertices are in order of appearance. The file's
/// normals are ignored. Several solids in one file make one mesh.
Mesh parse_stl(const MeshSource& source);

/// True if the content can only be PLY, or only STL.
bool looks_like_ply(const std::string& bytes);
bool looks_like_stl(const std::string& bytes);

}  // namespace voxelume
