// SPDX-License-Identifier: Apache-2.0
// Volumetric image -> the buffer of a display whose panel turns around Y_E: angle by radius by
// height, with one byte (RGB332) or two (RGB565) a cell.
#include <xxhash.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/volume/volume_dither.hpp"
#include "runtime/io/volume/volume_json.hpp"

namespace voxelume {

namespace {

constexpr double kPi = 3.141592653589793;

/// The number of levels above 0 of red, green and blue, and the left shifts of their bits.
struct Packing {
    int levels[3];
    int shifts[3];
    size_t bytes;
};
constexpr Packing kRgb332 = {{7, 7, 3}, {5, 2, 0}, 1};
constexpr Packing kRgb565 = {{31, 63, 31}, {11, 5, 0}, 2};

/// The cylinder inside the volume's box, with its axis along Y_E through the middle.
struct Cylinder {
    const Volume& volume;
    CylinderSize size;

    double radius() const {  // metres
        const VolumeFrame& frame = volume.frame;
        return 0.5 * std::min(frame.edge.x * frame.size.x, frame.edge.z * frame.size.z);
    }
    /// The volume's column of voxels at the middle of a cell. Angle 0 is image right, -X_E, and
    /// angles grow counter-clockwise as seen from above.
    glm::ivec3 column_at(int angle, int ring) const {
        const VolumeFrame& frame = volume.frame;
        const double turn = 2 * kPi * (angle + 0.5) / size.angles;
        const double r = radius() * (ring + 0.5) / size.radii;
        const auto along = [&](int axis, double metres) {
            const double voxel = 0.5 * frame.size[axis] + metres / frame.edge[axis];
            return std::clamp(int(std::floor(voxel)), 0, frame.size[axis] - 1);
        };
        return {along(0, -r * std::cos(turn)), 0, along(2, r * std::sin(turn))};
    }
    /// The position of a voxel in the volume's arrays, or -1 if it isn't listed.
    int64_t find(const glm::ivec3& cell) const {
        const glm::ivec3& n = volume.frame.size;
        const uint64_t index =
            uint64_t(cell.x) +
            uint64_t(n.x) * (uint64_t(cell.y) + uint64_t(n.y) * uint64_t(cell.z));
        const auto found = std::ranges::lower_bound(volume.indices, index);
        if (found == volume.indices.end() || *found != index) return -1;
        return found - volume.indices.begin();
    }
};

int pack(const Packing& packing, const glm::vec3& light, float threshold) {
    int word = 0;
    for (int color = 0; color < 3; ++color)
        word |= level_of(srgb_share(light[color]), packing.levels[color], threshold)
                << packing.shifts[color];
    return word;
}

std::vector<uint8_t> make_buffer(const Cylinder& cylinder, const Packing& packing,
                                 const DeviceOptions& options) {
    const auto& [angles, radii, heights] = cylinder.size;
    std::vector<uint8_t> buffer(size_t(angles) * size_t(radii) * size_t(heights) * packing.bytes);
    const Volume& volume = cylinder.volume;
    size_t at = 0;
    for (int angle = 0; angle < angles; ++angle)
        for (int ring = 0; ring < radii; ++ring) {
            glm::ivec3 cell = cylinder.column_at(angle, ring);
            for (int height = 0; height < heights; ++height, at += packing.bytes) {
                cell.y = height;
                const int64_t i = cylinder.find(cell);
                if (i < 0) continue;
                const int word = pack(packing,
                                      light_of(volume.colors[size_t(i)],
                                               volume.opacities[size_t(i)], options.exposure),
                                      threshold_at(options.dither, ring, height, angle));
                buffer[at] = uint8_t(word & 0xff);
                if (packing.bytes == 2) buffer[at + 1] = uint8_t(word >> 8);
            }
        }
    return buffer;
}

}  // namespace

CylinderSize cylinder_size(const VolumeFrame& frame, const DeviceOptions& options) {
    CylinderSize size{options.angles, options.radii, frame.size.y};
    if (size.radii == 0) size.radii = std::max(1, std::min(frame.size.x, frame.size.z) / 2);
    // With this number the outermost ring's cells are as wide as they are deep.
    if (size.angles == 0) size.angles = int(std::ceil(2 * kPi * size.radii));
    return size;
}

void write_volume_cylinder(const VolumePath& path, const Volume& volume, VolumeFormat format,
                           const DeviceOptions& options) {
    const Packing& packing = format == VolumeFormat::rgb332 ? kRgb332 : kRgb565;
    const Cylinder cylinder{volume, cylinder_size(volume.frame, options)};
    AtomicFile file(path);
    const std::vector<uint8_t> buffer = make_buffer(cylinder, packing, options);
    VolumeJson header = start_header(path, volume, format);
    header["shape"] = {cylinder.size.heights, cylinder.size.radii, cylinder.size.angles};
    header["axes"] = {"height", "radius", "angle"};
    header["axis_order"] = "heights fastest, bottom up, then radii outwards, then angles";
    header["angle"] = "0 to the image's right, counter-clockwise as seen from above";
    header["radius"] = cylinder.radius();
    header["height"] = volume.frame.edge.y * volume.frame.size.y;
    header["bits"] = packing.bytes == 1 ? "rrrgggbb, sRGB" : "rrrrrggggggbbbbb, sRGB";
    header["dither"] = options.dither == Dither::bayer8 ? "bayer8" : "none";
    header["exposure"] = options.exposure;
    header["bytes"] = buffer.size();
    header["xxh3_64"] = fmt::format("{:016x}", XXH3_64bits(buffer.data(), buffer.size()));
    file.write(buffer.data(), buffer.size());
    file.commit();
    write_json(header_path_of(path), header);
}

}  // namespace voxelume
