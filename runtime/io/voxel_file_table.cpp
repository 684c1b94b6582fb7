// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxel_file_table.hpp"

#include <algorithm>

#include "runtime/base/files/input_file.hpp"
#include "runtime/io/arrays/array_files.hpp"
#include "runtime/io/arrays/array_voxels.hpp"

namespace voxelume {
namespace {

constexpr std::array<VoxelFileFormat, 9> kVoxelFiles = {{
    {"numpy array", {".npy"}, "\x93NUMPY", read_npy_header, nullptr},
    {"NRRD array", {".nrrd", ".nhdr"}, "NRRD000", read_nrrd_header, nullptr},
    {"NIfTI scan",
     {".nii", ".nii.gz", ".hdr", ".hdr.gz", ".img", ".img.gz"},
     "",
     read_nifti_header,
     nullptr},
    {"stack of PNG slices", {".png"}, "", read_png_stack_header, nullptr, true},
    {"Qubicle file", {".qb"}, "", nullptr, read_qb},
    {"KV6 voxel model", {".kv6"}, "Kvxl", nullptr, read_kv6},
    {"binvox file", {".binvox"}, "#binvox", nullptr, read_binvox},
    {"Goxel file", {".gox"}, "GOX ", nullptr, read_gox},
    {"Minecraft schematic", {".schem", ".schematic", ".litematic"}, "", nullptr, read_schematic},
}};

bool is_named(const VoxelFileFormat& format, const std::filesystem::path& path) {
    std::string name = path.filename().string();
    std::ranges::transform(name, name.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return std::ranges::any_of(format.endings, [&](std::string_view ending) {
        if (ending.empty() || name.size() <= ending.size() || !name.ends_with(ending)) return false;
        const char before = name[name.size() - ending.size() - 1];
        return !format.is_numbered || (before >= '0' && before <= '9');
    });
}

/// The first bytes of files that other readers read: OpenVDB, MagicaVoxel, this program's models,
/// and pictures of Radiance, whose names end in .hdr, too.
constexpr std::array<std::string_view, 4> kMarksOfOthers = {
    {{" BDV\0\0\0\0", 8}, "VOX ", "\x89VXM\r\n\x1a\n", "#?"}};

}  // namespace

std::span<const VoxelFileFormat> voxel_file_table() {
    return kVoxelFiles;
}

const VoxelFileFormat* voxel_file_format(const std::filesystem::path& path) {
    const InputFile file(path);
    std::string start(std::min<uint64_t>(16, file.size()), '\0');
    file.read(0, start.data(), start.size());
    for (const VoxelFileFormat& format : kVoxelFiles)
        if (!format.mark.empty() && start.starts_with(format.mark)) return &format;
    // The name decides if the mark is damaged, so that the format's own reader refuses the file.
    const VoxelFileFormat* const named = voxel_format_named(path);
    const bool is_of_others = std::ranges::any_of(
        kMarksOfOthers, [&](std::string_view mark) { return start.starts_with(mark); });
    return is_of_others ? nullptr : named;
}

const VoxelFileFormat* voxel_format_named(const std::filesystem::path& name) {
    for (const VoxelFileFormat& format : kVoxelFiles)
        if (is_named(format, name)) return &format;
    return nullptr;
}

VoxelModel read_voxel_file(const VoxelFileFormat& format, const std::filesystem::path& path,
                           Surface surface, const VoxelValues& values) {
    if (lists_primitives(surface))
        InputFile(path).refuse("has no exact surface: give it \"cubes\" or \"smooth\"");
    if (format.art) {
        if (values.is_there())
            InputFile(path).refuse("has voxels and no values: leave out \"iso\" and \"label\"");
        if (!shows_voxels(surface))
            InputFile(path).refuse("holds voxels alone: give it \"surface\": \"cubes\"");
        return format.art(path).model;
    }
    const CellArray array = format.array(path);
    return stores_distances(surface) ? surface_of_array(array, values)
                                     : cubes_of_array(array, values);
}

}  // namespace voxelume
