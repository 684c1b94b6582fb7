// SPDX-License-Identifier: Apache-2.0
// The formats of volumetric images, and their options.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace voxelume {

enum class VolumeFormat : uint8_t {
    vdb,           ///< .vdb: OpenVDB
    exr,           ///< .exr: deep scanline OpenEXR; layout `rays`
    nrrd,          ///< .nrrd: dense RGBA
    raw,           ///< .raw and .json: dense arrays and a header
    slices,        ///< name.####.png: a PNG per slice k, and name.json
    ply,           ///< .ply: points in the world
    kv6,           ///< .kv6: voxels of Voxlap and Slab6; layout `lattice`
    planes,        ///< .planes: one bit a voxel, for swept projectors; layout `lattice`
    color_planes,  ///< .cplanes: three bits a voxel, one colour after another; layout `lattice`
    rgb332,        ///< .rgb332: a byte a voxel of a turning display; layout `lattice`
    rgb565         ///< .rgb565: two bytes a voxel of a turning display; layout `lattice`
};

/// The formats' names in the order of the enumeration, as --format, headers and messages use them.
inline constexpr std::array<std::string_view, 11> kVolumeFormatNames = {
    "vdb", "exr",    "nrrd",         "raw",    "slices", "ply",
    "kv6", "planes", "color-planes", "rgb332", "rgb565"};

constexpr std::string_view volume_format_name(VolumeFormat format) {
    return kVolumeFormatNames[size_t(format)];
}

enum class Dither : uint8_t {
    none,   ///< nearest level
    bayer8  ///< ordered, 8 x 8 thresholds shifted from plane to plane
};

/// The axis of the observer along which a projection plane is swept.
enum class SweepAxis : uint8_t { x, y, z };

/// The options of the formats for displays.
struct DeviceOptions {
    float exposure = 0;  ///< stops: colours are multiplied by 2^exposure
    Dither dither = Dither::bayer8;
    SweepAxis sweep = SweepAxis::y;  ///< axis of planes
    int angles = 0;  ///< cells around a cylinder; 0: outer cells are as wide as deep
    int radii = 0;   ///< number of cells along a cylinder's radius; 0: half of the shorter side
};

struct VolumeOptions {
    std::optional<VolumeFormat> format;  ///< if empty, the path's ending decides
    bool compress = true;                ///< for NRRD: gzip instead of raw
    bool all_values = false;             ///< for NRRD: depth, object and kind in addition to RGBA
    DeviceOptions device;
};

}  // namespace voxelume
