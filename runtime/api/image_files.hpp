// SPDX-License-Identifier: Apache-2.0
// A caller's image -> files, by the format that their names' ending tells.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "runtime/api/border/handles.hpp"
#include "runtime/io/image/image_format_table.hpp"
#include "runtime/voxelume/image.hpp"

namespace voxelume::api {

/// The format of an image that is to be written under this name. Throws Error::usage for names with
/// other endings.
const ImageFormatEntry& format_of_image(const std::filesystem::path& file);

/// The format of an image's file by its first bytes, OpenEXR if they are no format's. Throws
/// Error::input for a file that can't be read.
const ImageFormatEntry& format_in_file(const std::filesystem::path& file);

/// Writes the channels that the options name. Throws Error::usage for wrong options and names, and
/// Error::output.
void write_image(const std::filesystem::path& file, const v1::Image::Implementation& image,
                 const v1::ImageFileOptions& options);

/// Writes a band of the image to the file, which the first band begins.
void write_band(const std::filesystem::path& file, const ImageWindow& whole,
                const v1::Image::Implementation& band, const v1::ImageFileOptions& options,
                std::unique_ptr<ImageRows>& rows);

/// The bytes of the file that `write_image` writes under a name with this ending.
std::string encode_image(std::string_view ending, const v1::Image::Implementation& image,
                         const v1::ImageFileOptions& options);

}  // namespace voxelume::api
