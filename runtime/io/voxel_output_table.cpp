// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxel_output_table.hpp"

#include <algorithm>
#include <array>

#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"

namespace voxelume {
namespace {

constexpr std::array<VoxelOutputFormat, 7> kFormats = {{
    {".vxm", nullptr, true, false},
    {".vdb", nullptr, true, false},
    {".vox", write_vox, false, true, 254},
    {".kv6", write_kv6, false, false},
    {".binvox", write_binvox, false, false},
    {".npy", write_npy, false, false},
    {".nrrd", write_nrrd, true, false},
}};

}  // namespace

std::span<const VoxelOutputFormat> voxel_output_table() {
    return kFormats;
}

const VoxelOutputFormat* voxel_output_format(const std::filesystem::path& path) {
    const auto row = std::ranges::find(kFormats, ending_of(path), &VoxelOutputFormat::ending);
    return row == kFormats.end() ? nullptr : &*row;
}

const VoxelOutputFormat& check_voxel_output(const std::filesystem::path& path) {
    if (const VoxelOutputFormat* const format = voxel_output_format(path)) return *format;
    std::string endings;
    for (const VoxelOutputFormat& format : kFormats) {
        if (!endings.empty()) endings += &format == &kFormats.back() ? " or " : ", ";
        endings += format.ending;
    }
    throw Error(ErrorKind::usage, "{}: the name of voxels ends in {}", SourcePlace(path.string()),
                endings);
}

}  // namespace voxelume
