// SPDX-License-Identifier: Apache-2.0
// The table of the formats of images. Everything that is particular to one format is in its row.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/image/image.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/image/radiance_picture.hpp"

namespace voxelume {

/// The storage format of an image. A file format uses those options that it supports.
struct ImageStorage {
    PngOptions png;                                      ///< options of formats for screens
    ExrStorage exr;                                      ///< options of formats that hold channels
    std::map<std::string, std::string> attributes = {};  ///< texts for the header, of the latter
};

/// One format. A new format is a row of the table and the functions that its row names, which lie
/// in files of their own in this folder. A function is null where the format isn't used for that.
struct ImageFormatEntry {
    std::string_view ending;  ///< ending of file names: ".exr"
    std::string_view start;   ///< the first bytes of each file
    bool holds_channels;      ///< every channel as it is; otherwise colours for a screen, in codes

    // Images:
    void (*write)(const std::filesystem::path& path, const Image& image, const ImageStorage& how);
    /// Begins the same file, which takes the image in bands.
    std::unique_ptr<ImageRows> (*begin)(const std::filesystem::path& path,
                                        const ImageWindow& window, const ImageStorage& how);
    std::string (*encode)(const Image& image, const ImageStorage& how);
    Image (*read)(const std::filesystem::path& path);

    // Pictures of the sky, in linear colours. `max_pixels` are allowed:
    ColorPicture (*read_colors)(const std::filesystem::path& path, uint64_t max_pixels);
    glm::ivec2 (*read_size)(const std::filesystem::path& path);

    // Textures, whose bytes may lie in a file of another format; `name` opens messages:
    Picture (*parse_texture)(std::span<const uint8_t> bytes, const std::filesystem::path& name);
};

/// All rows.
std::span<const ImageFormatEntry> image_format_table();

/// The row that names of files with this ending have; null if there is none.
const ImageFormatEntry* image_format_of(std::string_view ending);

/// The row of a file that begins with these bytes; null if there is none.
const ImageFormatEntry* image_format_of(std::span<const uint8_t> bytes);

/// The endings of the formats that have one of the functions, for messages: ".exr or .png".
template <class Function>
std::string image_endings(Function ImageFormatEntry::*function) {
    std::vector<std::string_view> endings;
    for (const ImageFormatEntry& entry : image_format_table())
        if (entry.*function != nullptr) endings.push_back(entry.ending);
    std::string text(endings.front());
    for (size_t i = 1; i < endings.size(); ++i)
        text.append(i + 1 < endings.size() ? ", " : " or ").append(endings[i]);
    return text;
}

}  // namespace voxelume
