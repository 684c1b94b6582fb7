// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image/picture.hpp"

#include "runtime/base/files/input_file.hpp"
#include "runtime/io/image/image_format_table.hpp"
#include "runtime/io/image_codec/image_codec.hpp"

namespace voxelume {

Picture parse_jpeg(std::span<const uint8_t> bytes, const std::filesystem::path& name) {
    if (decodes_apart())
        return ask_picture(PictureKind::jpeg, bytes, name, kMaxTexturePixels, [](int, int) {});
    return decode_jpeg(bytes, name);
}

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
    return parse_picture(file.bytes(), path);
}

}  // namespace voxelume
