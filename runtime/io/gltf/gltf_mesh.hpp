// SPDX-License-Identifier: Apache-2.0
// Meshes of a glTF file -> Mesh, whose groups are the file's materials.
#pragma once

#include <string>

#include "runtime/geometry/mesh.hpp"
#include "runtime/io/gltf/gltf_file.hpp"

namespace voxelume {

/// A mesh of the file, numbered from 1 on, in its own space; with 0 everything that the file's
/// scene shows, in the scene's space. Groups are named by GltfFile::material_name().
///
/// Points and lines of a mesh without triangles become triangles without area; if it has triangles,
/// they are left out with a note. Base colour textures are those of metallic-roughness and of
/// specular-glossiness materials. Throws Error::input for a file that is damaged or has nothing to
/// show, Error::limit for too many.
Mesh gltf_mesh(const GltfFile& file, int part);

/// Reads a mesh of any format; of a glTF file, everything that its scene shows. Throws as
/// read_mesh() does.
Mesh read_mesh_file(const std::filesystem::path& path);

}  // namespace voxelume
