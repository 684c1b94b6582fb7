#include "runtime/io/volume/volume_file.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "runtime/base/atomic_file.hpp"
#include "runtime/base/frame_path.hpp"
#include "runtime/base/input_file.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/volume/volume_formats.hpp"
#include "runtime/io/volume/volume_json.hpp"
#include "runtime/scene_file/scene_fields.hpp"

namespace voxelume {

namespace {

/// In the order of VolumeFormat.
constexpr std::array<std::string_view, 11> kNames = {"vdb",          "exr",    "nrrd",  "raw",
                                                     "slices",       "ply",    "kv6",   "planes",
                                                     "color-planes", "rgb332", "rgb565"};

constexpr std::array kEndings = {
    std::pair{".vdb", VolumeFormat::vdb},       std::pair{".exr", VolumeFormat::exr},
    std::pair{".nrrd", VolumeFormat::nrrd},     std::pair{".raw", VolumeFormat::raw},
    std::pair{".json", VolumeFormat::raw},      std::pair{".png", VolumeFormat::slices},
    std::pair{".ply", VolumeFormat::ply},       std::pair{".kv6", VolumeFormat::kv6},
    std::pair{".planes", VolumeFormat::planes}, std::pair{".cplanes", VolumeFormat::color_planes},
    std::pair{".rgb332", VolumeFormat::rgb332}, std::pair{".rgb565", VolumeFormat::rgb565}};

/// The most bytes that are written for voxels that show nothing.
constexpr double kMostDenseBytes = 64.0 * 1024 * 1024 * 1024;
/// The most bytes of a display's buffer, which is made in memory.
constexpr double kMostBufferBytes = 4.0 * 1024 * 1024 * 1024;

[[noreturn]] void refuse_layout(const VolumePath& path, const char* reason) {
    throw Error(ErrorKind::usage, "{}: {}", path.string(), reason);
}

void check_layout(const VolumePath& path, const VolumeFrame& frame, VolumeFormat format) {
    const bool rays = frame.layout == VolumeLayout::rays;
    const bool is_pyramid = frame.display.shape == DisplayShape::pyramid;
    if (format == VolumeFormat::exr && !rays)
        refuse_layout(path,
                      "a deep image holds sight rays, and this display is a lattice; write .vdb, "
                      ".nrrd, .raw, .ply or PNG slices");
    if (format == VolumeFormat::vdb && rays && !world_from_voxels(frame) &&
        !(is_pyramid && frame.display.near > 0))
        refuse_layout(path,
                      "OpenVDB holds the sight rays of a box, or of a pyramid that begins ahead "
                      "of the observer (near above 0); write .exr, .nrrd, .raw or .ply, or render "
                      "a lattice");
    if (format >= VolumeFormat::kv6 && rays)
        refuse_layout(path,
                      "the formats for displays hold a lattice, and this display is one of sight "
                      "rays; write .exr, .nrrd, .raw, .ply or PNG slices");
}

/// Bytes of the part that doesn't depend on how many voxels show something.
double dense_bytes(const VolumeFrame& frame, VolumeFormat format, const VolumeOptions& options) {
    const double voxels = double(frame.size.x) * frame.size.y * frame.size.z;
    const CylinderSize cylinder = cylinder_size(frame, options.device);
    const double turned = double(cylinder.angles) * cylinder.radii * cylinder.heights;
    switch (format) {
        case VolumeFormat::nrrd:
            return voxels * (options.all_values ? 28 : 16);
        case VolumeFormat::raw:
            return voxels * 25;
        case VolumeFormat::slices:
            return voxels * 4;
        case VolumeFormat::planes:
            return voxels / 8;
        case VolumeFormat::color_planes:
            return voxels / 8 * 3;
        case VolumeFormat::rgb332:
            return turned;
        case VolumeFormat::rgb565:
            return turned * 2;
        default:
            return 0;
    }
}

void check_size(const VolumePath& path, const VolumeFrame& frame, VolumeFormat format,
                const VolumeOptions& options) {
    constexpr glm::ivec3 kMostKv6(256, 255, 256);  // x, z and y of its own axes
    const glm::ivec3& size = frame.size;
    if (format == VolumeFormat::kv6 &&
        (size.x > kMostKv6.x || size.y > kMostKv6.y || size.z > kMostKv6.z))
        throw Error(ErrorKind::limit,
                    "{}: KV6 holds 256 x 255 x 256 voxels, and this display has {} x {} x {}",
                    path.string(), size.x, size.y, size.z);
    const double bytes = dense_bytes(frame, format, options);
    const double most = format >= VolumeFormat::planes ? kMostBufferBytes : kMostDenseBytes;
    if (bytes > most)
        throw Error(ErrorKind::limit,
                    "{}: {:.3g} GB with its empty voxels, and {:.3g} GB are possible; .vdb and "
                    ".exr hold only voxels that show something",
                    path.string(), bytes / 1e9, most / 1e9);
}

/// A file of the name that write_volume starts with can be made there, and its header overwrites
/// nothing else.
void check_path(const VolumePath& path, VolumeFormat format) {
    const std::string name = path.filename().string();
    if (format != VolumeFormat::slices) {
        const AtomicFile trial(path);
        if (format == VolumeFormat::vdb) check_vdb_output(path);
        if (format == VolumeFormat::raw)
            check_header(path.extension() == ".json" ? path : header_path_of(path), format);
        else if (format >= VolumeFormat::planes)
            check_header(header_path_of(path), format);
        return;
    }
    if (frame_path(path.string(), 0, false) == path.string())
        throw Error(ErrorKind::usage,
                    "{}: a stack of slices needs their number in its name: {}.####.png",
                    path.string(), path.stem().string());
    const AtomicFile trial(frame_path(path.string(), 0, true));
    check_header(slices_header_of(path), format);
}

VolumeFormat format_for(const VolumePath& path, const VolumeOptions& options) {
    return options.format ? *options.format : volume_format_of(path);
}

}  // namespace

VolumeFormat volume_format_of(const std::filesystem::path& path) {
    const std::string ending = path.extension().string();
    std::string list;
    for (const auto& [known, format] : kEndings) {
        if (ending == known) return format;
        list += fmt::format("{}{}", list.empty() ? "" : " ", known);
    }
    throw Error(ErrorKind::usage, "{}: the name of a volume ends in one of {}", path.string(),
                list);
}

std::string_view volume_format_name(VolumeFormat format) {
    return kNames[size_t(format)];
}

VolumeFormat volume_format_named(std::string_view name) {
    for (size_t i = 0; i < kNames.size(); ++i)
        if (name == kNames[i]) return static_cast<VolumeFormat>(i);
    throw Error(
        ErrorKind::usage, "there is no format {}{}", quote(std::string(name)),
        suggest(std::string(name), std::vector<std::string_view>(kNames.begin(), kNames.end())));
}

void check_volume_output(const std::filesystem::path& path, const VolumeFrame& frame,
                         const VolumeOptions& options) {
    const VolumeFormat format = format_for(path, options);
    check_layout(path, frame, format);
    check_size(path, frame, format, options);
    check_path(path, format);
}

void write_volume(const std::filesystem::path& path, const Volume& volume,
                  const VolumeOptions& options) {
    const std::string fault = find_fault(volume);
    if (!fault.empty())
        throw Error(ErrorKind::output, "{}: can't be written: {}", path.string(), fault);
    check_volume_output(path, volume.frame, options);
    const VolumeFormat format = format_for(path, options);
    switch (format) {
        case VolumeFormat::vdb:
            return write_volume_vdb(path, volume);
        case VolumeFormat::exr:
            return write_volume_exr(path, volume);
        case VolumeFormat::nrrd:
            return write_volume_nrrd(path, volume, options);
        case VolumeFormat::raw:
            return write_volume_raw(path, volume);
        case VolumeFormat::slices:
            return write_volume_slices(path, volume);
        case VolumeFormat::ply:
            return write_volume_ply(path, volume);
        case VolumeFormat::kv6:
            return write_volume_kv6(path, volume, options.device);
        case VolumeFormat::planes:
        case VolumeFormat::color_planes:
            return write_volume_planes(path, volume, format, options.device);
        case VolumeFormat::rgb332:
        case VolumeFormat::rgb565:
            return write_volume_cylinder(path, volume, format, options.device);
    }
}

Volume read_volume(const std::filesystem::path& path) {
    const auto read = [&]() -> Volume {
        switch (volume_format_of(path)) {
            case VolumeFormat::vdb:
                return read_volume_vdb(path);
            case VolumeFormat::exr:
                return read_volume_exr(path);
            case VolumeFormat::nrrd:
                return read_volume_nrrd(path);
            case VolumeFormat::raw:
                return read_volume_raw(path);
            default:
                throw Error(ErrorKind::usage,
                            "{}: volumes are read from .vdb, .exr, .nrrd, .raw or .json",
                            path.string());
        }
    };
    Volume volume = read();
    if (const std::string fault = find_fault(volume); !fault.empty()) InputFile(path).refuse(fault);
    return volume;
}

}  // namespace voxelume
