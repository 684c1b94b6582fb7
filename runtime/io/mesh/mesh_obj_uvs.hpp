// SPDX-License-Identifier: Apache-2.0
// Places on textures in an OBJ file, which may stand behind the faces whose corners name them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "runtime/base/decimal.hpp"
#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// The index of a place that a corner names at `text`, `known` places into the file; kNoUv for one
/// that can't be, and where there is none, as in `7//4`.
inline uint32_t obj_uv_index(const char* text, const Integer& number, size_t known) {
    if (number.end == text) return kNoUv;
    const int64_t index =
        number.value < 0 ? static_cast<int64_t>(known) + number.value : number.value - 1;
    return index >= 0 && index < int64_t{kNoUv} ? static_cast<uint32_t>(index) : kNoUv;
}

/// True if some corner of a mesh or of its next face, whose corners name `face`, has a place.
inline bool has_obj_uvs(const Mesh& mesh, std::span<const uint32_t> face) {
    return !mesh.triangle_uvs.empty() ||
           std::ranges::any_of(face, [](uint32_t uv) { return uv != kNoUv; });
}

/// Settles what corners name, at the end of the file. A file whose faces name none has none.
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
