// SPDX-License-Identifier: Apache-2.0
// Volumetric image -> PLY: a point in the world for every visible voxel.
#include <cmath>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/volume/volume_formats.hpp"

namespace voxelume {

namespace {

/// The bytes of a point in the file.
struct PlyPoint {
    glm::vec3 position;  ///< metres, world
    uint8_t red, green, blue, alpha;
    uint32_t object;
};
static_assert(sizeof(PlyPoint) == 20);

/// The position of a voxel's point. In the layout `rays` a voxel that shows a hit has its point at
/// the hit's depth; every other voxel has it in its middle.
glm::dvec3 position_of(const Volume& volume, size_t i) {
    const VolumeFrame& frame = volume.frame;
    const glm::ivec3 cell = cell_of(frame, volume.indices[i]);
    const bool is_met = frame.layout == VolumeLayout::rays &&
                        volume.kinds[i] == VoxelKind::object && std::isfinite(volume.depths[i]);
    if (!is_met) return voxel_center(frame, cell);
    const glm::dvec3 p_observer =
        point_on_ray(frame, glm::dvec2(cell) + 0.5, double(volume.depths[i]));
    return glm::dvec3(frame.world_from_observer * glm::dvec4(p_observer, 1));
}

std::string header_text(AtomicFile& file, const Volume& volume, size_t points) {
    std::string text =
        "ply\nformat binary_little_endian 1.0\ncomment voxelume volume\n"
        "comment metres, world, Y up; colour sRGB, not multiplied by alpha\n";
    for (const auto& [key, value] : volume.attributes) {
        if ((key + value).find_first_of("\n\r") != std::string::npos)
            file.fail(fmt::format("its attribute \"{}\" has more than a line", key));
        text += fmt::format("comment {}: {}\n", key, value);
    }
    return text + fmt::format(
                      "element vertex {}\nproperty float x\nproperty float y\n"
                      "property float z\nproperty uchar red\nproperty uchar green\n"
                      "property uchar blue\nproperty uchar alpha\nproperty uint object\n"
                      "end_header\n",
                      points);
}

}  // namespace

void write_volume_ply(const VolumePath& path, const Volume& volume) {
    AtomicFile file(path);
    std::vector<PlyPoint> points;
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        if (!(volume.opacities[i] > 0)) continue;
        const glm::vec3& color = volume.colors[i];
        points.push_back({glm::vec3(position_of(volume, i)), srgb_code(color.r), srgb_code(color.g),
                          srgb_code(color.b), uint8_t(std::lround(volume.opacities[i] * 255.0f)),
                          volume.objects[i]});
    }
    const std::string header = header_text(file, volume, points.size());
    file.write(header.data(), header.size());
    file.write(points.data(), points.size() * sizeof points[0]);
    file.commit();
}

}  // namespace voxelume
