// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/picture.hpp"

#include "runtime/base/files/input_file.hpp"
#include "runtime/io/image/image_format_table.hpp"

namespace voxelume {

Picture parse_picture(std::span<const uint8_t> bytes, const std::filesystem::path& name) {
    const ImageFormatEntry* format = image_format_of(bytes);
    if (format != nullptr && format->parse_texture != nullptr)
        return format->parse_texture(bytes, name);
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
