// SPDX-License-Identifier: Apache-2.0
// KHR_draco_mesh_compression and EXT_meshopt_compression: the compressed parts of a glTF file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace voxelume {

class GltfFile;
class GltfValue;

/// The decoded parts of a file, by the numbers of their buffer views and accessors.
struct GltfDecoded {
    std::map<size_t, std::vector<uint8_t>> views;  ///< buffer views
    std::map<size_t, std::vector<uint8_t>>
        accessors;  ///< elements without gaps; indices have 32 bits
};

/// Decodes a file's compressed views, and then its Draco primitives. Throws Error::input for
/// damaged data and Error::limit for too many.
void decode_gltf_views(const GltfFile& file, GltfDecoded& decoded);
void decode_gltf_primitives(const GltfFile& file, GltfDecoded& decoded);

/// True if a buffer has no bytes because all views of it are compressed.
bool is_gltf_fallback(const GltfValue& buffer);

}  // namespace voxelume
