// SPDX-License-Identifier: Apache-2.0
// The normals of an OBJ file, which may stand behind the faces whose corners name them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// The index of a normal that a corner names, `known` normals into the file; kNoNormal for one that
/// can't be.
inline uint32_t obj_normal_index(int64_t number, size_t known) {
    const int64_t index = number < 0 ? static_cast<int64_t>(known) + number : number - 1;
    return index >= 0 && index < int64_t{kNoNormal} ? static_cast<uint32_t>(index) : kNoNormal;
}

/// True if some corner of a mesh or of its next face, whose corners name `face`, has a normal.
inline bool has_obj_normals(const Mesh& mesh, std::span<const uint32_t> face) {
    return !mesh.triangle_normals.empty() ||
           std::ranges::any_of(face, [](uint32_t n) { return n != kNoNormal; });
}

/// Settles what corners name, at the end of the file. A file whose faces name none has none.
inline void settle_obj_normals(Mesh& mesh) {
    bool found = false;
    for (glm::uvec3& t : mesh.triangle_normals)
        for (int i = 0; i < 3; ++i) {
            if (t[i] >= mesh.normals.size()) t[i] = kNoNormal;
            found = found || t[i] != kNoNormal;
        }
    if (found) return;
    mesh.normals = {};
    mesh.triangle_normals = {};
}

}  // namespace voxelume
