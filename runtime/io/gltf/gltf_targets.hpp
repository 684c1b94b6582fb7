// SPDX-License-Identifier: Apache-2.0
// Morph targets of a mesh of a glTF file.
#pragma once

#include <vector>

#include "runtime/geometry/mesh_targets.hpp"
#include "runtime/io/gltf/gltf_file.hpp"

namespace voxelume {

/// The maximum number of offsets of a mesh's targets, positions and normals together: 768 MiB.
inline constexpr uint64_t kMaxTargetOffsets = uint64_t{1} << 26;

/// The targets of a mesh, numbered from 1 on, whose vertices are those of gltf_mesh(file, part).
/// Throws Error::input for accessors that don't fit the mesh, and Error::limit, before any is read,
/// for more than kMaxTargetOffsets.
std::vector<MorphTarget> gltf_targets(const GltfFile& file, int part);

/// The number of the mesh's targets: the largest of any of its primitives.
size_t count_gltf_targets(const GltfValue& mesh);

}  // namespace voxelume
