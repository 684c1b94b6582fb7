// SPDX-License-Identifier: Apache-2.0
// Flat images for callers: their planes and files.
#include "runtime/image/image.hpp"

#include <algorithm>
#include <utility>

#include "runtime/api/exposure.hpp"
#include "runtime/api/frame_hash.hpp"
#include "runtime/api/guarded.hpp"
#include "runtime/api/handles.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/base/text.hpp"
#include "runtime/image/join_images.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/scene_file/document/scene_fields.hpp"
#include "runtime/voxelume/render.hpp"

namespace voxelume {
namespace {

bool is_png(const std::filesystem::path& file) {
    const InputFile input(file);
    char start[4] = {};
    input.read(0, start, std::min<uint64_t>(sizeof start, input.size()));
    return std::string_view(start, sizeof start) == "\x89PNG";
}

/// A picture's codes as parts of 255: what is compared is what is seen.
Image image_from(const Picture& picture) {
    Image image{picture.width, picture.height, {}, {}, {}};
    constexpr const char* kNames[] = {"R", "G", "B", "A"};
    for (size_t channel = 0; channel < 4; ++channel) {
        std::vector<float> values;
        values.reserve(picture.pixels.size());
        for (const auto& pixel : picture.pixels)
            values.push_back(static_cast<float>(pixel[channel]) / 255.0f);
        image.planes[kNames[channel]] = std::move(values);
    }
    return image;
}

const Plane<float>& plane_of(const Image& image, std::string_view channel) {
    const auto found = image.planes.find(std::string(channel));
    if (found != image.planes.end()) return found->second;
    std::vector<std::string_view> names;
    names.reserve(image.planes.size());
    for (const auto& [name, plane] : image.planes) names.push_back(name);
    throw Error(ErrorKind::usage, "the image has no channel {}{}", quote(channel),
                suggest(channel, names));
}

/// Nothing where the image has no such numbers.
std::span<const uint32_t> ids_of(const Image& image, const char* plane) {
    const auto found = image.id_planes.find(plane);
    if (found == image.id_planes.end()) return {};
    return {found->second.data(), found->second.size()};
}

/// Whether a channel is among those of a row.
bool is_of(const std::string& channel, const v1::ChannelRow& row) {
    return std::ranges::any_of(row.planes, [&](const std::string_view plane) {
        return plane.ends_with('_') ? channel.starts_with(plane) : channel == plane;
    });
}

/// Whether an OpenEXR file leaves a channel out.
bool is_left_out(const std::string& channel, const v1::Channels& channels) {
    return std::ranges::any_of(v1::channel_table(), [&](const v1::ChannelRow& row) {
        return !(channels.*row.member) && is_of(channel, row);
    });
}

/// The texts for the header of a file: the frame's hash becomes the file's stamp.
api::Attributes attributes_for(const v1::Image::Implementation& image, std::string_view ending,
                               const v1::ImageFileOptions& options) {
    api::Attributes attributes = image.attributes;
    if (const auto hash = attributes.extract(api::kFrameHash))
        attributes[api::kStamp] = stamp_of(api::hash_for_image(hash.mapped(), ending, options));
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

PngOptions png_options(const v1::Image::Implementation& image,
                       const v1::ImageFileOptions& options) {
    PngOptions png;
    const api::Attributes attributes = attributes_for(image, ".png", options);
    if (const auto stamp = attributes.find(api::kStamp); stamp != attributes.end())
        png.stamp = stamp->second;
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
        if (key.starts_with("cryptomatte/") && key.ends_with("/name") &&
            !image.planes.contains(layer + "00.R"))
            gone.push_back(key.substr(0, key.rfind('/') + 1));
    for (const std::string& start : gone)
        std::erase_if(image.attributes,
                      [&](const auto& attribute) { return attribute.first.starts_with(start); });
}

/// Calls `write` with the image that has the channels asked for, and how it is stored.
template <class Write>
auto with_channels(const v1::Image::Implementation& image, const v1::ImageFileOptions& options,
                   const Write& write) {
    const ExrStorage storage(options.float_color ? ColorDepth::float32 : ColorDepth::float16,
                             options.multi_part);
    const auto is_extra = [&](const auto& plane) {
        return is_left_out(plane.first, options.channels);
    };
    if (std::ranges::none_of(image.image->planes, is_extra) &&
        std::ranges::none_of(image.image->id_planes, is_extra))
        return write(*image.image, storage);
    Image shown = *image.image;
    std::erase_if(shown.planes, is_extra);
    std::erase_if(shown.id_planes, is_extra);
    forget_mattes(shown);
    return write(shown, storage);
}

[[noreturn]] void refuse_ending(const std::string& name) {
    throw Error(ErrorKind::usage, "{}: the name of an image ends in .exr or .png",
                SourcePlace(name));
}

void write(const std::filesystem::path& file, const v1::Image::Implementation& image,
           const v1::ImageFileOptions& options) {
    const std::string extension = ending_of(file);
    if (extension == ".png") {
        write_png(file, *image.image, png_options(image, options));
    } else if (extension == ".exr") {
        with_channels(image, options, [&](const Image& shown, const ExrStorage& storage) {
            return write_exr(file, shown, storage, attributes_for(image, extension, options));
        });
    } else {
        refuse_ending(file.string());
    }
}

std::string encoded(std::string_view extension, const v1::Image::Implementation& image,
                    const v1::ImageFileOptions& options) {
    if (extension == ".png") return png_bytes(*image.image, png_options(image, options));
    if (extension != ".exr") refuse_ending(std::string(extension));
    return with_channels(image, options, [&](const Image& shown, const ExrStorage& storage) {
        return exr_bytes(shown, storage, attributes_for(image, extension, options));
    });
}

}  // namespace

v1::Image api::handle_of(std::shared_ptr<const Image> image, Attributes attributes,
                         bool holds_codes) {
    return v1::Image(std::make_shared<const v1::Image::Implementation>(
        v1::Image::Implementation{std::move(image), std::move(attributes), holds_codes}));
}

namespace v1 {

Image Image::read(const std::filesystem::path& file) {
    return api::guarded([&] {
        const bool holds_codes = is_png(file);
        auto image = holds_codes ? image_from(read_png(file)) : read_exr(file);
        return api::handle_of(std::make_shared<const voxelume::Image>(std::move(image)), {},
                              holds_codes);
    });
}

int Image::width() const {
    return api::inside(*this).width;
}

int Image::height() const {
    return api::inside(*this).height;
}

bool Image::holds_codes() const {
    return implementation_->holds_codes;
}

std::vector<std::string> Image::channels() const {
    std::vector<std::string> names;
    for (const auto& [name, plane] : api::inside(*this).planes) names.push_back(name);
    return names;
}

bool Image::has(std::string_view channel) const {
    return api::inside(*this).planes.contains(std::string(channel));
}

std::span<const float> Image::plane(std::string_view channel) const {
    return api::guarded([&]() -> std::span<const float> {
        const auto& plane = plane_of(api::inside(*this), channel);
        return {plane.data(), plane.size()};
    });
}

std::span<const uint32_t> Image::object_ids() const {
    return ids_of(api::inside(*this), "objectId");
}

std::span<const uint32_t> Image::material_ids() const {
    return ids_of(api::inside(*this), "materialId");
}

void Image::copy(std::string_view channel, std::span<float> to) const {
    const std::span<const float> from = plane(channel);
    if (from.size() != to.size())
        throw Error(ErrorKind::usage, "a plane of " + std::to_string(from.size()) +
                                          " values doesn't go into " + std::to_string(to.size()));
    std::ranges::copy(from, to.begin());
}

void Image::write(const std::filesystem::path& file, const ImageFileOptions& options) const {
    api::guarded([&] { voxelume::write(file, *implementation_, options); });
}

std::string Image::encode(std::string_view ending, const ImageFileOptions& options) const {
    return api::guarded([&] { return encoded(ending, *implementation_, options); });
}

void merge_image_files(const std::vector<std::filesystem::path>& parts,
                       const std::vector<std::filesystem::path>& files, const std::string& hash,
                       const ImageFileOptions& options) {
    api::guarded([&] {
        std::vector<voxelume::Image> images;
        images.reserve(parts.size());
        for (const std::filesystem::path& part : parts) images.push_back(read_exr(part));
        voxelume::Image whole = join_images(std::move(images));
        api::Attributes attributes = std::exchange(whole.attributes, {});
        attributes.erase(api::kStamp);
        attributes.erase("noise");  // of the first part alone
        attributes[api::kFrameHash] = hash;
        const Image image = api::handle_of(
            std::make_shared<const voxelume::Image>(std::move(whole)), std::move(attributes));
        for (const std::filesystem::path& file : files) image.write(file, options);
    });
}

}  // namespace v1
}  // namespace voxelume
