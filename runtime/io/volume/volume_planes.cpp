// SPDX-License-Identifier: Apache-2.0
// Volumetric image -> planes of one bit a voxel for displays that sweep a projection plane. A
// .planes has one plane for each slice; a .cplanes has three: red, green and blue.
#include <xxhash.h>

#include <algorithm>
#include <array>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/volume/volume_dither.hpp"
#include "runtime/io/volume/volume_json.hpp"

namespace voxelume {

namespace {

/// An axis of the raster: an axis of the volume, run backwards if `backwards` is true.
struct RasterAxis {
    int axis;
    bool backwards;
    const char* name;
    int at(const glm::ivec3& cell, const glm::ivec3& size) const {
        return backwards ? size[axis] - 1 - cell[axis] : cell[axis];
    }
};

/// The axes of columns, rows and planes. Image right is -X_E.
struct Raster {
    RasterAxis column, row, plane;
};

Raster raster_of(SweepAxis sweep) {
    switch (sweep) {
        case SweepAxis::x:  // from the left to the right, as seen from the left
            return {{2, true, "-Z_E"}, {1, true, "-Y_E"}, {0, true, "-X_E"}};
        case SweepAxis::y:  // from the bottom to the top, as seen from above
            return {{0, true, "-X_E"}, {2, true, "-Z_E"}, {1, false, "+Y_E"}};
        case SweepAxis::z:  // away from the observer, as it sees them
            break;
    }
    return {{0, true, "-X_E"}, {1, true, "-Y_E"}, {2, false, "+Z_E"}};
}

/// The bits of all planes: rows of whole bytes, with the first column in the highest bit.
struct BitPlanes {
    int columns, rows, planes;
    std::vector<uint8_t> bytes;

    BitPlanes(const glm::ivec3& size, const Raster& raster, int colors)
        : columns(size[raster.column.axis]),
          rows(size[raster.row.axis]),
          planes(size[raster.plane.axis] * colors),
          bytes(row_bytes() * size_t(rows) * size_t(planes)) {}

    size_t row_bytes() const { return (size_t(columns) + 7) / 8; }
    void set(int column, int row, int plane) {
        bytes[(size_t(plane) * size_t(rows) + size_t(row)) * row_bytes() + size_t(column) / 8] |=
            uint8_t(0x80 >> (column & 7));
    }
};

BitPlanes make_planes(const Volume& volume, const Raster& raster, bool in_color,
                      const DeviceOptions& options) {
    const glm::ivec3& size = volume.frame.size;
    BitPlanes bits(size, raster, in_color ? 3 : 1);
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const glm::ivec3 cell = cell_of(volume.frame, volume.indices[i]);
        const int column = raster.column.at(cell, size), row = raster.row.at(cell, size);
        const int plane = raster.plane.at(cell, size);
        const float threshold = threshold_at(options.dither, column, row, plane);
        const glm::vec3 light = light_of(volume.colors[i], volume.opacities[i], options.exposure);
        if (!in_color) {
            if (luminance(light) > threshold) bits.set(column, row, plane);
            continue;
        }
        for (int color = 0; color < 3; ++color)
            if (light[color] > threshold) bits.set(column, row, 3 * plane + color);
    }
    return bits;
}

}  // namespace

void write_volume_planes(const VolumePath& path, const Volume& volume, VolumeFormat format,
                         const DeviceOptions& options) {
    const bool in_color = format == VolumeFormat::color_planes;
    const Raster raster = raster_of(options.sweep);
    AtomicFile file(path);
    const BitPlanes bits = make_planes(volume, raster, in_color, options);
    VolumeJson header = start_header(path, volume, format);
    header["shape"] = {bits.columns, bits.rows, bits.planes};
    header["axes"] = {raster.column.name, raster.row.name, raster.plane.name};
    header["axis_order"] = "columns fastest, then rows, then planes";
    header["bits"] = "1 a voxel, the first column in the highest bit, rows of whole bytes";
    header["row_bytes"] = bits.row_bytes();
    header["plane_colors"] = in_color ? VolumeJson{"red", "green", "blue"} : VolumeJson{"white"};
    header["dither"] = options.dither == Dither::bayer8 ? "bayer8" : "none";
    header["exposure"] = options.exposure;
    header["bytes"] = bits.bytes.size();
    header["xxh3_64"] = fmt::format("{:016x}", XXH3_64bits(bits.bytes.data(), bits.bytes.size()));
    file.write(bits.bytes.data(), bits.bytes.size());
    file.commit();
    write_json(header_path_of(path), header);
}

}  // namespace voxelume
