// SPDX-License-Identifier: Apache-2.0
// Accessor of a glTF file -> numbers: every component type, normalized or not, sparse or not.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/io/gltf/gltf_file.hpp"

namespace voxelume {

/// The maximum number of elements of an accessor, which is that of a mesh's vertices.
inline constexpr uint64_t kMaxGltfElements = uint64_t{1} << 31;

/// The values of an accessor, element after element.
struct GltfValues {
    uint64_t count = 0;
    int components = 1;         ///< components of an element; those of a matrix are in column order
    std::vector<float> values;  ///< normalized integers as 0..1 or -1..1
};

/// Reads the accessor that `key` of `from` names. Its floats may be NaN. Throws Error::input for a
/// type that isn't one of `components` (by their numbers), and for an accessor that doesn't fit its
/// buffer.
GltfValues gltf_values(const GltfFile& file, const GltfValue& from, const char* key,
                       std::initializer_list<int> components);

/// The number of elements of the accessor that `key` of `from` names. Reads none of them.
uint64_t count_gltf_values(const GltfFile& file, const GltfValue& from, const char* key);

/// The number of an accessor's component type. Throws Error::input for an unknown number.
uint64_t gltf_component_type(const GltfValue& accessor);

/// Reads the indices that `key` of `from` names; each is below `limit`.
std::vector<uint32_t> gltf_indices(const GltfFile& file, const GltfValue& from, const char* key,
                                   uint64_t limit);

}  // namespace voxelume
