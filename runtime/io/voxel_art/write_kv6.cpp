// SPDX-License-Identifier: Apache-2.0
// Voxels -> KV6, by way of a volumetric image.
#include <algorithm>
#include <numeric>

#include "runtime/base/error.hpp"
#include "runtime/io/mesh/mesh_color.hpp"
#include "runtime/io/volume/volume_formats.hpp"
#include "runtime/io/voxel_art/cube_list.hpp"

namespace voxelume {

WriterNotes write_kv6(const std::filesystem::path& path, const CubeList& cubes) {
    constexpr int kMaxKv6Side = 1024;  // side of the array of bits in which visible faces are found
    const glm::ivec3& n = cubes.size;
    if (std::max({n.x, n.y, n.z}) > kMaxKv6Side)
        throw Error(ErrorKind::limit,
                    "{} x {} x {} voxels are more than the {} along each axis that a .kv6 is "
                    "written with",
                    n.x, n.y, n.z, kMaxKv6Side);
    Volume volume;
    volume.frame.layout = VolumeLayout::lattice;
    volume.frame.size = n;
    // The writer's x is opposite to X, and its y is Z here: the volume is turned about Y.
    const auto index_of = [&](const glm::ivec3& cell) {
        const glm::ivec3 at(n.x - 1 - cell.x, cell.y, n.z - 1 - cell.z);
        return uint64_t(at.x) + uint64_t(n.x) * (uint64_t(at.y) + uint64_t(n.y) * uint64_t(at.z));
    };
    for (size_t i = 0; i < cubes.cells.size(); ++i) {
        const uint32_t color = cubes.colors.empty() ? 0xFFFFFF : cubes.colors[i];
        volume.indices.push_back(index_of(cubes.cells[i]));
        volume.colors.emplace_back(
            linear_from_srgb(glm::dvec3(color & 255, color >> 8 & 255, color >> 16 & 255) / 255.0));
        volume.opacities.push_back(1);
    }
    write_volume_kv6(path, volume, {});
    WriterNotes notes = {"a .kv6 has the voxels of surfaces alone"};
    const auto is_clear = [](uint32_t color) { return color >> 24 != 0; };
    if (std::ranges::any_of(cubes.colors, is_clear))
        notes.emplace_back("a .kv6 has no transparency");
    return notes;
}

}  // namespace voxelume
