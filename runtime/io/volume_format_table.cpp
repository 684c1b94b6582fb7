// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/volume_format_table.hpp"

#include <climits>

#include "runtime/base/error.hpp"
#include "runtime/base/files/atomic_file.hpp"
#include "runtime/base/frame_path.hpp"
#include "runtime/base/text.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/volume/volume_json.hpp"

namespace voxelume {
namespace {

using Frame = const VolumeFrame&;
using Options = const VolumeOptions&;

/// The maximum of the bytes of a file that don't depend on the number of shown voxels.
constexpr double kMaxFileBytes = 64.0 * 1024 * 1024 * 1024;
/// The maximum size of a display's buffer, which is built in memory, in bytes.
constexpr double kMaxBufferBytes = 4.0 * 1024 * 1024 * 1024;

constexpr glm::ivec3 kAnySize(INT_MAX);
constexpr glm::ivec3 kMaxKv6(256, 255, 256);  // sizes along KV6's own axes x, z and y

const char* any_layout(Frame) {
    return nullptr;
}

const char* rays_only(Frame frame) {
    return frame.layout == VolumeLayout::rays
               ? nullptr
               : "a deep image holds sight rays, and this display is a lattice; write .vdb, "
                 ".nrrd, .raw, .ply or PNG slices";
}

const char* lattice_only(Frame frame) {
    return frame.layout != VolumeLayout::rays
               ? nullptr
               : "the formats for displays hold a lattice, and this display is one of sight "
                 "rays; write .exr, .nrrd, .raw, .ply or PNG slices";
}

const char* affine_or_perspective(Frame frame) {
    const bool is_perspective =
        shape_row(frame.display).projection == SightProjection::perspective &&
        frame.display.near > 0;
    return frame.layout != VolumeLayout::rays || world_from_voxels(frame) || is_perspective
               ? nullptr
               : "OpenVDB holds the sight rays of a box, or of a pyramid that begins ahead "
                 "of the observer (near above 0); write .exr, .nrrd, .raw or .ply, or render "
                 "a lattice";
}

double voxels(Frame frame) {
    return double(frame.size.x) * frame.size.y * frame.size.z;
}

double no_bytes(Frame, Options) {
    return 0;
}

/// The dense bytes of a format that takes `times` bytes a voxel.
template <int times>
double bytes_a_voxel(Frame frame, Options) {
    return voxels(frame) * times;
}

/// The dense bytes of a format that takes `times` bits a voxel.
template <int times>
double bits_a_voxel(Frame frame, Options) {
    return voxels(frame) / 8 * times;
}

double nrrd_bytes(Frame frame, Options options) {
    return voxels(frame) * (options.all_values ? 28 : 16);
}

/// The dense bytes of a turning display's format that takes `times` bytes a voxel.
template <int times>
double cylinder_bytes(Frame frame, Options options) {
    const CylinderSize size = cylinder_size(frame, options.device);
    return double(size.angles) * size.radii * size.heights * times;
}

void check_file(const VolumePath& path, VolumeFormat) {
    const AtomicFile trial(path);
}

void check_vdb(const VolumePath& path, VolumeFormat format) {
    check_file(path, format);
    check_vdb_output(path);
}

void check_raw(const VolumePath& path, VolumeFormat format) {
    check_file(path, format);
    check_header(ending_of(path) == ".json" ? path : header_path_of(path), format);
}

void check_with_header(const VolumePath& path, VolumeFormat format) {
    check_file(path, format);
    check_header(header_path_of(path), format);
}

void check_slices(const VolumePath& path, VolumeFormat format) {
    if (frame_path(path.string(), 0, false) == path.string())
        throw Error(ErrorKind::usage,
                    "{}: a stack of slices needs their number in its name: {}.####.png",
                    path.string(), path.stem().string());
    const AtomicFile trial(frame_path(path.string(), 0, true));
    check_header(slices_header_of(path), format);
}

std::vector<VolumePath> one_file(const VolumePath& path) {
    return {path};
}

std::vector<VolumePath> with_header(const VolumePath& path) {
    return {path, header_path_of(path)};
}

void write_kv6_volume(const VolumePath& path, const Volume& volume, Options options) {
    write_volume_kv6(path, volume, options.device);
}

/// Adapts a writer that has no options to the table's signature.
template <auto write>
void written_by(const VolumePath& path, const Volume& volume, Options) {
    write(path, volume);
}

/// Adapts a writer that serves several formats to the table's signature.
template <auto write, VolumeFormat format>
void written_as(const VolumePath& path, const Volume& volume, Options options) {
    write(path, volume, format, options.device);
}

using enum VolumeFormat;

// clang-format off
const std::array<VolumeFormatEntry, 11> kTable = {{
    // The columns: format, endings, layout_fault, dense_bytes, max_dense_bytes, max_size,
    // check_path, files, write, read.
    {vdb, {".vdb"}, affine_or_perspective, no_bytes, kMaxFileBytes, kAnySize,
     check_vdb, one_file, written_by<write_volume_vdb>, read_volume_vdb},
    {exr, {".exr"}, rays_only, no_bytes, kMaxFileBytes, kAnySize,
     check_file, one_file, written_by<write_volume_exr>, read_volume_exr},
    {nrrd, {".nrrd"}, any_layout, nrrd_bytes, kMaxFileBytes, kAnySize,
     check_file, one_file, write_volume_nrrd, read_volume_nrrd},
    {raw, {".raw", ".json"}, any_layout, bytes_a_voxel<25>, kMaxFileBytes, kAnySize,
     check_raw, raw_files_of, written_by<write_volume_raw>, read_volume_raw},
    {slices, {".png"}, any_layout, bytes_a_voxel<4>, kMaxFileBytes, kAnySize,
     check_slices, slice_files_of, written_by<write_volume_slices>, nullptr},
    {ply, {".ply"}, any_layout, no_bytes, kMaxFileBytes, kAnySize,
     check_file, one_file, written_by<write_volume_ply>, nullptr},
    {kv6, {".kv6"}, lattice_only, no_bytes, kMaxFileBytes, kMaxKv6,
     check_file, one_file, write_kv6_volume, nullptr},
    {planes, {".planes"}, lattice_only, bits_a_voxel<1>, kMaxBufferBytes, kAnySize,
     check_with_header, with_header, written_as<write_volume_planes, planes>, nullptr},
    {color_planes, {".cplanes"}, lattice_only, bits_a_voxel<3>, kMaxBufferBytes, kAnySize,
     check_with_header, with_header, written_as<write_volume_planes, color_planes>, nullptr},
    {rgb332, {".rgb332"}, lattice_only, cylinder_bytes<1>, kMaxBufferBytes, kAnySize,
     check_with_header, with_header, written_as<write_volume_cylinder, rgb332>, nullptr},
    {rgb565, {".rgb565"}, lattice_only, cylinder_bytes<2>, kMaxBufferBytes, kAnySize,
     check_with_header, with_header, written_as<write_volume_cylinder, rgb565>, nullptr},
}};
// clang-format on

}  // namespace

std::span<const VolumeFormatEntry> volume_format_table() {
    return kTable;
}

const VolumeFormatEntry& entry_of(VolumeFormat format) {
    return kTable[size_t(format)];
}

}  // namespace voxelume
