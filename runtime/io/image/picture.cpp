// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/picture.hpp"

#include <algorithm>
#include <array>

#include "runtime/base/files/input_file.hpp"

namespace voxelume {
namespace {

bool begins_with(std::span<const uint8_t> bytes, std::span<const uint8_t> mark) {
    return bytes.size() >= mark.size() && std::equal(mark.begin(), mark.end(), bytes.begin());
}

}  // namespace

Picture parse_picture(std::span<const uint8_t> bytes, const std::filesystem::path& name) {
    constexpr std::array<uint8_t, 4> kPng = {0x89, 'P', 'N', 'G'};
    constexpr std::array<uint8_t, 3> kJpeg = {0xff, 0xd8, 0xff};
    if (begins_with(bytes, kPng)) return parse_png(bytes, name, kMaxTexturePixels);
    if (begins_with(bytes, kJpeg)) return parse_jpeg(bytes, name);
    throw Error(ErrorKind::input, "{}: neither PNG nor JPEG, which textures have to be",
                SourcePlace(name.string()));
}

Picture read_picture(const std::filesystem::path& path) {
    const InputFile file(path);
    if (file.size() > 9 * kMaxTexturePixels) file.refuse("is too large for a texture");
    std::vector<uint8_t> bytes(file.size());
    file.read(0, bytes.data(), bytes.size());
    return parse_picture(bytes, path);
}

}  // namespace voxelume
