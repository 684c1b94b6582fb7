// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/png_values.hpp"

#include <fmt/format.h>

#include "runtime/io/image_codec/image_codec.hpp"

namespace voxelume {
namespace {

/// The maximum of files' bytes that are in memory together, unless one has more.
constexpr uint64_t kTogether = uint64_t{1} << 26;

/// Throws for a file that can't be within the limit: a number of 16 bits takes two bytes.
void check_slice_size(const InputFile& file) {
    if (file.size() > 9 * kMaxSlicePixels) file.refuse("is too large for a slice");
}

std::vector<std::byte> decode_each(std::span<const std::vector<uint8_t>> pngs,
                                   std::span<const std::filesystem::path> names,
                                   const PngShape& shape) {
    std::vector<std::byte> values;
    values.reserve(pngs.size() * shape.bytes());
    for (size_t i = 0; i < pngs.size(); ++i) {
        const std::vector<std::byte> own = decode_png_values(pngs[i], names[i], shape);
        values.insert(values.end(), own.begin(), own.end());
    }
    return values;
}

}  // namespace

PngShape read_png_shape(const std::filesystem::path& path) {
    const InputFile file(path);
    check_slice_size(file);
    if (decodes_apart()) return ask_png_shape(file);
    return decode_png_shape(file.bytes(), path);
}

std::vector<std::byte> read_png_values(std::span<const std::filesystem::path> paths,
                                       const PngShape& shape) {
    std::vector<std::byte> values;
    while (!paths.empty()) {
        std::vector<std::vector<uint8_t>> pngs;
        for (uint64_t bytes = 0; pngs.size() < paths.size() && bytes < kTogether;) {
            const InputFile file(paths[pngs.size()]);
            check_slice_size(file);
            pngs.push_back(file.bytes());
            bytes += file.size();
        }
        const auto names = paths.first(pngs.size());
        const std::vector<std::byte> own =
            decodes_apart() ? ask_png_values(pngs, names, shape) : decode_each(pngs, names, shape);
        values.insert(values.end(), own.begin(), own.end());
        paths = paths.subspan(pngs.size());
    }
    return values;
}

}  // namespace voxelume
