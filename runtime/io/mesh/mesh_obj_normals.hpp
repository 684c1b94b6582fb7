// SPDX-License-Identifier: Apache-2.0
// The normals of an OBJ file, which may follow the faces that refer to them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// The index of the normal to which a corner refers by `number`, when `known` normals were read;
/// kNoNormal for an impossible number.
inline uint32_t obj_normal_index(int64_t number, size_t known) {
    const int64_t index = number < 0 ? static_cast<int64_t>(known) + number : number - 1;
    return index >= 0 && index < int64_t{kNoNormal} ? static_cast<uint32_t>(index) : kNoNormal;
}

/// True if some corner of a mesh or of its next face, whose corners name `face`, has a normal.
inline bool has_obj_normals(const Mesh& mesh, std::span<const uint32_t> face) {
    return !mesh.triangle_normals.empty() ||
           std::ranges::any_of(face, [](uint32_t n) { return n != kNoNormal; });
}

/// Checks the indices of normals at the end of the file. Without a valid one, the mesh has no
/// normals.
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
