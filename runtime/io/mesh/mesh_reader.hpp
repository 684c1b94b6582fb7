// Mesh file -> Mesh: OBJ, PLY (ascii and binary of both endians) and STL (ascii and binary).
#pragma once

#include "runtime/geometry/mesh.hpp"

#include <filesystem>
#include <string>

namespace voxelume {

struct MeshSource;

/// Reads a triangle mesh.
///
/// A file whose content says what it is (PLY by its first line, binary STL by its size, ascii STL
/// by "solid" ... "facet" or "endsolid") is read as that, whatever its name; otherwise the
/// extension decides. Vertex colours are taken as sRGB and come out linear. Polygons are cut into
/// triangles. What a file has beyond struct Mesh (normals, texture coordinates, lines, points,
/// free-form curves) is skipped; vertices that no face uses and triangles without area are kept.
/// Units are taken as metres.
///
/// Throws Error::input, its sentence starting with the file and the line or byte, for a file that
/// is missing, unreadable, damaged or without triangles, and Error::limit for one that is too
/// large.
Mesh read_mesh(const std::filesystem::path& path);

/// The bytes of the file, for parse_mesh. Throws Error::input and Error::limit as read_mesh does.
std::string read_mesh_bytes(const std::filesystem::path& path);

/// The same for a file's bytes in memory. `name` opens the messages, and its extension counts.
Mesh parse_mesh(const std::string& bytes, const std::filesystem::path& name);

/// OBJ (Wavefront): `v`, `f` and `usemtl`; other statements of the format are skipped, unknown
/// words refused. `v x y z r g b` has a colour in [0, 1], and a vertex without one is white if
/// others have one. Indices may be negative but not run ahead of the vertices. `g` and `o` don't
/// make groups. A face of fewer than three corners is an error.
Mesh parse_obj(const MeshSource& source);

/// PLY 1.0: elements `vertex` and `face` with `vertex_indices` (or `vertex_index`) in this order,
/// every scalar type; other elements and properties are skipped. Colours are `red green blue` (or
/// `diffuse_red` ...) as uchar, ushort, or float in [0, 1]. A face of fewer than three corners and
/// data behind the last element are errors.
Mesh parse_ply(const MeshSource& source);

/// STL. Corners at the same place (-0 equals 0, no tolerance) become one vertex, so that triangles
/// are connected as in the other formats; vertices are in order of appearance. The file's normals
/// are ignored. Several solids in one file make one mesh.
Mesh parse_stl(const MeshSource& source);

/// Whether the content can only be PLY, or only be STL.
bool looks_like_ply(const std::string& bytes);
bool looks_like_stl(const std::string& bytes);

}  // namespace voxelume
