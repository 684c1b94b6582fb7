// SPDX-License-Identifier: Apache-2.0
// The bytes of main memory that the loaded contents of a file take.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/geometry/voxel_model.hpp"

namespace voxelume {

template <class... Values>
inline uint64_t bytes_in(const std::vector<Values>&... arrays) {
    return (... + (arrays.size() * sizeof(Values)));
}

inline uint64_t mesh_bytes(const Mesh& mesh) {
    uint64_t texels = 0;
    for (const Texture& texture : mesh.textures) texels += texture.image->texels.size();
    return 4 * texels + bytes_in(mesh.positions, mesh.triangles, mesh.vertex_colors,
                                 mesh.triangle_colors, mesh.uvs, mesh.triangle_uvs, mesh.normals,
                                 mesh.triangle_normals, mesh.triangle_group);
}

inline uint64_t voxel_bytes(const VoxelModel& voxels) {
    return voxels.color_codes.size() + mesh_bytes(voxels.mesh) +
           bytes_in(voxels.slots, voxels.coordinates, voxels.occupancy, voxels.distance,
                    voxels.attributes, voxels.colors, voxels.normals);
}

}  // namespace voxelume
