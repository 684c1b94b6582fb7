// SPDX-License-Identifier: Apache-2.0
// The UVs of an OBJ file, which may follow the faces that refer to them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "runtime/base/decimal.hpp"
#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// The index of the UV to which a corner refers at `text`, when `known` UVs were read; kNoUv for an
/// impossible number, and without one, as in `7//4`.
inline uint32_t obj_uv_index(const char* text, const Integer& number, size_t known) {
    if (number.end == text) return kNoUv;
    const int64_t index =
        number.value < 0 ? static_cast<int64_t>(known) + number.value : number.value - 1;
    return index >= 0 && index < int64_t{kNoUv} ? static_cast<uint32_t>(index) : kNoUv;
}

/// True if some corner of a mesh or of its next face, whose corners have the indices `face`, has a
/// UV.
inline bool has_obj_uvs(const Mesh& mesh, std::span<const uint32_t> face) {
    return !mesh.triangle_uvs.empty() ||
           std::ranges::any_of(face, [](uint32_t uv) { return uv != kNoUv; });
}

/// Checks the indices of UVs at the end of the file. Without a valid one, the mesh has no UVs.
inline void settle_obj_uvs(Mesh& mesh) {
    bool found = false;
    for (glm::uvec3& t : mesh.triangle_uvs)
        for (int i = 0; i < 3; ++i) {
            if (t[i] >= mesh.uvs.size()) t[i] = kNoUv;
            found = found || t[i] != kNoUv;
        }
    if (found) return;
    mesh.uvs = {};
    mesh.triangle_uvs = {};
}

}  // namespace voxelume
