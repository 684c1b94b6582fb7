// Volumetric images on disk: one front for every format. scenes/VOLUMES.md describes the formats.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "runtime/image/volume.hpp"

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

enum class Dither : uint8_t {
    none,   ///< nearest level
    bayer8  ///< ordered, 8 x 8 thresholds shifted from plane to plane
};

/// The axis of the observer along which a projection plane is swept.
enum class SweepAxis : uint8_t { x, y, z };

/// What the formats for displays need to know beyond the volume.
struct DeviceOptions {
    float exposure = 0;  ///< stops: colours are multiplied by 2^exposure
    Dither dither = Dither::bayer8;
    SweepAxis sweep = SweepAxis::y;  ///< of planes
    int angles = 0;                  ///< of cylinders; 0: as many as the outer voxels need
    int radii = 0;                   ///< of cylinders; 0: half of the shorter side
};

struct VolumeOptions {
    std::optional<VolumeFormat> format;  ///< else the path's ending says it
    bool compress = true;                ///< NRRD: gzip instead of raw
    bool all_values = false;             ///< NRRD: depth, object and kind beside RGBA
    DeviceOptions device;
};

/// The format that a path's ending stands for. Throws Error::usage with the endings there are.
VolumeFormat volume_format_of(const std::filesystem::path& path);

/// "vdb", "color-planes", ...; and back: Throws Error::usage with the nearest name.
std::string_view volume_format_name(VolumeFormat format);
VolumeFormat volume_format_named(std::string_view name);

/// Throws what write_volume would throw for any volume in this frame, before there is one:
/// Error::usage for a layout that the format can't hold, Error::limit for sizes beyond the format
/// or beyond 64 GiB of dense voxels, Error::output where no file can be made.
void check_volume_output(const std::filesystem::path& path, const VolumeFrame& frame,
                         const VolumeOptions& options = {});

/// Writes the volume. Each file appears under its name whole or not at all, a header after its
/// data; the same volume gives the same bytes. Throws as check_volume_output does, and
/// Error::output for a volume that find_fault() refuses.
void write_volume(const std::filesystem::path& path, const Volume& volume,
                  const VolumeOptions& options = {});

/// Reads a .vdb, .exr, .nrrd or .raw/.json that voxelume wrote; what each of them keeps is in
/// scenes/VOLUMES.md. Throws Error::input for a file that is missing, damaged or not a volume of
/// voxelume, Error::usage for the formats that aren't read.
Volume read_volume(const std::filesystem::path& path);

}  // namespace voxelume
