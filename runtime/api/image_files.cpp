// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/image_files.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "runtime/api/exposure.hpp"
#include "runtime/api/frame_hash.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/base/text.hpp"
#include "runtime/image/cryptomatte.hpp"
#include "runtime/image/image.hpp"

namespace voxelume {
namespace {

/// True if a channel is among those of a row.
bool is_of(const std::string& channel, const v1::ChannelRow& row) {
    return std::ranges::any_of(row.planes, [&](const std::string_view plane) {
        return plane.ends_with('_') ? channel.starts_with(plane) : channel == plane;
    });
}

/// True if an OpenEXR file leaves a channel out.
bool is_left_out(const std::string& channel, const v1::Channels& channels) {
    return std::ranges::any_of(v1::channel_table(), [&](const v1::ChannelRow& row) {
        return !(channels.*row.member) && is_of(channel, row);
    });
}

/// The texts for the header of a file: the frame's hash becomes the file's stamp. Images that
/// aren't a frame's have a stamp for its check alone.
api::Attributes attributes_for(const v1::Image::Implementation& image,
                               const ImageFormatEntry& format,
                               const v1::ImageFileOptions& options) {
    api::Attributes attributes = image.attributes;
    if (const auto hash = attributes.extract(api::kFrameHash))
        attributes[api::kStamp] = stamp_of(api::hash_for_image(hash.mapped(), format, options));
    else if (!image.image->attributes.contains(api::kStamp))
        attributes.try_emplace(api::kStamp, stamp_of(kNoFrame));
    return attributes;
}

ViewTransform transform_of(v1::ViewTransform transform) {
    switch (transform) {
        case v1::ViewTransform::none:
            return ViewTransform::none;
        case v1::ViewTransform::filmic:
            return ViewTransform::filmic;
        case v1::ViewTransform::agx:
            return ViewTransform::agx;
        case v1::ViewTransform::srgb:
            break;
    }
    return ViewTransform::srgb;
}

PngOptions png_options(const v1::Image::Implementation& image, const api::Attributes& attributes,
                       const v1::ImageFileOptions& options) {
    PngOptions png;
    if (const auto stamp = attributes.find(api::kStamp); stamp != attributes.end())
        png.stamp = stamp->second;
    png.pixel_aspect = attributes.contains(kPixelAspect) ? pixel_aspect_in(attributes)
                                                         : pixel_aspect_in(image.image->attributes);
    png.exposure = api::exposure_inside(options.exposure);
    png.view_transform = transform_of(options.view_transform);
    if (options.png_bits != 8 && options.png_bits != 16)
        throw Error(ErrorKind::usage, "a PNG has 8 or 16 bits a channel, not {}", options.png_bits);
    png.bits = options.png_bits;
    png.keep_alpha = attributes.contains(api::kTransparent) ||
                     image.image->attributes.contains(api::kTransparent);
    return png;
}

/// Removes the names of mattes whose planes the image lacks.
void forget_mattes(Image& image) {
    std::vector<std::string> gone;
    for (const auto& [key, layer] : image.attributes)
        if (key.starts_with(kMatteKey) && key.ends_with("/name") &&
            !image.planes.contains(layer + "00.R"))
            gone.push_back(key.substr(0, key.rfind('/') + 1));
    for (const std::string& start : gone)
        std::erase_if(image.attributes,
                      [&](const auto& attribute) { return attribute.first.starts_with(start); });
}

/// The format that names with this ending have; `name` opens the message.
const ImageFormatEntry& format_of(std::string_view ending, const std::string& name) {
    const ImageFormatEntry* format = image_format_of(ending);
    if (format != nullptr && format->write != nullptr) return *format;
    throw Error(ErrorKind::usage, "{}: the name of an image ends in {}", SourcePlace(name),
                image_endings(&ImageFormatEntry::write));
}

/// Calls `write` with the image of the channels that are asked for, and with the way in which the
/// format stores them.
template <class Write>
auto with_storage(const v1::Image::Implementation& image, const ImageFormatEntry& format,
                  const v1::ImageFileOptions& options, const Write& write) {
    ImageStorage how;
    how.attributes = attributes_for(image, format, options);
    if (!format.holds_channels) {
        how.png = png_options(image, how.attributes, options);
        return write(*image.image, how);
    }
    how.exr = {options.float_color ? ColorDepth::float32 : ColorDepth::float16, options.multi_part};
    const auto is_extra = [&](const auto& plane) {
        return is_left_out(plane.first, options.channels);
    };
    if (std::ranges::none_of(image.image->planes, is_extra) &&
        std::ranges::none_of(image.image->id_planes, is_extra))
        return write(*image.image, how);
    const Image& all = *image.image;
    Image shown{all.width, all.height, {}, {}, all.attributes, all.first, all.frame};
    for (const auto& plane : all.planes)
        if (!is_extra(plane)) shown.planes.insert(plane);
    for (const auto& plane : all.id_planes)
        if (!is_extra(plane)) shown.id_planes.insert(plane);
    forget_mattes(shown);
    return write(shown, how);
}

}  // namespace

namespace api {

const ImageFormatEntry& format_of_image(const std::filesystem::path& file) {
    return format_of(ending_of(file), file.string());
}

const ImageFormatEntry& format_in_file(const std::filesystem::path& file) {
    const InputFile input(file);
    std::array<uint8_t, 4> start{};
    const size_t size = std::min<uint64_t>(start.size(), input.size());
    input.read(0, start.data(), size);
    const ImageFormatEntry* format = image_format_of(std::span<const uint8_t>(start.data(), size));
    if (format != nullptr && format->read != nullptr) return *format;
    return *image_format_of(std::string_view(".exr"));  // its reader reports what is wrong
}

void write_image(const std::filesystem::path& file, const v1::Image::Implementation& image,
                 const v1::ImageFileOptions& options) {
    const ImageFormatEntry& format = format_of_image(file);
    with_storage(image, format, options, [&](const Image& shown, const ImageStorage& how) {
        format.write(file, shown, how);
    });
}

void write_band(const std::filesystem::path& file, const ImageWindow& whole,
                const v1::Image::Implementation& band, const v1::ImageFileOptions& options,
                std::unique_ptr<ImageRows>& rows) {
    const ImageFormatEntry& format = format_of_image(file);
    with_storage(band, format, options, [&](const Image& shown, const ImageStorage& how) {
        if (!rows) rows = format.begin(file, whole, how);
        rows->add(shown);
    });
}

std::string encode_image(std::string_view ending, const v1::Image::Implementation& image,
                         const v1::ImageFileOptions& options) {
    const ImageFormatEntry& format = format_of(ending, std::string(ending));
    return with_storage(image, format, options, [&](const Image& shown, const ImageStorage& how) {
        return format.encode(shown, how);
    });
}

}  // namespace api

namespace v1 {

std::span<const ImageFormat> image_formats() {
    static const std::vector<ImageFormat> formats = [] {
        std::vector<ImageFormat> rows;
        for (const ImageFormatEntry& entry : image_format_table())
            if (entry.write != nullptr) rows.push_back({entry.ending, entry.holds_channels});
        return rows;
    }();
    return formats;
}

}  // namespace v1
}  // namespace voxelume
