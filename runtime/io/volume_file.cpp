// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/volume_file.hpp"

#include <algorithm>
#include <cctype>
#include <glm/vector_relational.hpp>
#include <vector>

#include "runtime/base/files/input_file.hpp"
#include "runtime/base/text.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/volume_format_table.hpp"

namespace voxelume {
namespace {

void check_layout(const VolumePath& path, const VolumeFrame& frame,
                  const VolumeFormatEntry& entry) {
    if (const char* fault = entry.layout_fault(frame))
        throw Error(ErrorKind::usage, "{}: {}", SourcePlace(path.string()), fault);
}

void check_size(const VolumePath& path, const VolumeFrame& frame, const VolumeFormatEntry& entry,
                const VolumeOptions& options) {
    const glm::ivec3 &size = frame.size, &max = entry.max_size;
    if (glm::any(glm::greaterThan(size, max))) {
        std::string name(volume_format_name(entry.format));
        std::ranges::transform(name, name.begin(), [](unsigned char c) { return toupper(c); });
        throw Error(ErrorKind::limit,
                    "{}: {} holds {} x {} x {} voxels, and this display has {} x {} x {}",
                    path.string(), name, max.x, max.y, max.z, size.x, size.y, size.z);
    }
    const double bytes = entry.dense_bytes(frame, options);
    if (bytes > entry.max_dense_bytes)
        throw Error(ErrorKind::limit,
                    "{}: {:.3g} GB with its empty voxels, and {:.3g} GB are possible; .vdb and "
                    ".exr hold only voxels that show something",
                    path.string(), bytes / 1e9, entry.max_dense_bytes / 1e9);
}

const VolumeFormatEntry& entry_for(const VolumePath& path, const VolumeOptions& options) {
    return entry_of(options.format ? *options.format : volume_format_of(path));
}

void check_output(const VolumePath& path, const VolumeFrame& frame, const VolumeFormatEntry& entry,
                  const VolumeOptions& options) {
    check_layout(path, frame, entry);
    check_size(path, frame, entry, options);
    entry.check_path(path, entry.format);
}

bool is_there(const VolumePath& file) {
    std::error_code error;
    return std::filesystem::is_regular_file(file, error);
}

}  // namespace

VolumeFormat volume_format_of(const std::filesystem::path& path) {
    const std::string ending = ending_of(path);
    std::string list;
    for (const VolumeFormatEntry& entry : volume_format_table())
        for (const char* known : entry.endings) {
            if (!known) continue;
            if (ending == known) return entry.format;
            list += fmt::format("{}{}", list.empty() ? "" : " ", known);
        }
    throw Error(ErrorKind::usage, "{}: the name of a volume ends in one of {}", path.string(),
                list);
}

VolumeFormat volume_format_named(std::string_view name) {
    const std::vector<std::string_view> names(kVolumeFormatNames.begin(), kVolumeFormatNames.end());
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return VolumeFormat(found - names.begin());
    throw Error(ErrorKind::usage, "there is no format {}{}", quote(name), suggest(name, names));
}

void check_volume_output(const std::filesystem::path& path, const VolumeFrame& frame,
                         const VolumeOptions& options) {
    check_output(path, frame, entry_for(path, options), options);
}

void write_volume(const std::filesystem::path& path, const Volume& volume,
                  const VolumeOptions& options) {
    const std::string fault = find_fault(volume);
    if (!fault.empty())
        throw Error(ErrorKind::output, "{}: can't be written: {}", SourcePlace(path.string()),
                    fault);
    const VolumeFormatEntry& entry = entry_for(path, options);
    check_output(path, volume.frame, entry, options);
    entry.write(path, volume, options);
}

std::vector<std::filesystem::path> volume_files(const std::filesystem::path& path) {
    std::vector<VolumePath> files = entry_of(volume_format_of(path)).files(path);
    if (!std::ranges::all_of(files, is_there)) files.clear();
    return files;
}

std::vector<std::filesystem::path> replaced_files(const std::filesystem::path& path) {
    const VolumeFormat format = volume_format_of(path);
    std::vector<VolumePath> files =
        format == VolumeFormat::slices ? found_slices_of(path) : entry_of(format).files(path);
    std::erase_if(files, [](const VolumePath& file) { return !is_there(file); });
    return files;
}

Volume read_volume(const std::filesystem::path& path) {
    const auto read = entry_of(volume_format_of(path)).read;
    if (!read)
        throw Error(ErrorKind::usage, "{}: volumes are read from .vdb, .exr, .nrrd, .raw or .json",
                    path.string());
    Volume volume = read(path);
    if (const std::string fault = find_fault(volume); !fault.empty()) InputFile(path).refuse(fault);
    return volume;
}

}  // namespace voxelume
