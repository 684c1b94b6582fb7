// SPDX-License-Identifier: Apache-2.0
// The choice of the normals by which light falls on a mesh.
#pragma once

#include <cstdint>

namespace voxelume {

enum class ShadingKind : uint8_t {
    automatic,  ///< the normals of the mesh's vertices, where it has some; else flat
    flat,       ///< each triangle's own normal
    smooth,     ///< as automatic, but a mesh without normals gets some
};

/// The shading of an exact mesh.
struct Shading {
    ShadingKind kind = ShadingKind::automatic;
    double crease_angle = 30;  ///< degrees, 0..180: faces that meet at more stay apart in `smooth`

    friend bool operator==(const Shading&, const Shading&) = default;
};

/// True if a mesh, with or without normals of its own, is shown with smooth normals.
constexpr bool has_shading_normals(const Shading& shading, bool mesh_has_normals) {
    return shading.kind == ShadingKind::smooth ||
           (shading.kind == ShadingKind::automatic && mesh_has_normals);
}

}  // namespace voxelume
