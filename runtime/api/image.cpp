// SPDX-License-Identifier: Apache-2.0
// Flat images for callers: their planes and files.
#include "runtime/image/image.hpp"

#include <algorithm>
#include <utility>

#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/api/frame_hash.hpp"
#include "runtime/api/image_files.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/base/text.hpp"
#include "runtime/image/join_images.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/scene_file/document/scene_fields.hpp"
#include "runtime/voxelume/render.hpp"

namespace voxelume {
namespace {

const Plane<float>& plane_of(const Image& image, std::string_view channel) {
    const auto found = image.planes.find(std::string(channel));
    if (found != image.planes.end()) return found->second;
    std::vector<std::string_view> names;
    names.reserve(image.planes.size());
    for (const auto& [name, plane] : image.planes) names.push_back(name);
    throw Error(ErrorKind::usage, "the image has no channel {}{}", quote(channel),
                suggest(channel, names));
}

/// The numbers in a plane of ids; empty where the image has no such plane.
std::span<const uint32_t> ids_of(const Image& image, const char* plane) {
    const auto found = image.id_planes.find(plane);
    if (found == image.id_planes.end()) return {};
    return {found->second.data(), found->second.size()};
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
        const ImageFormatEntry& format = api::format_in_file(file);
        return api::handle_of(std::make_shared<const voxelume::Image>(format.read(file)), {},
                              !format.holds_channels);
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
    api::guarded([&] { api::write_image(file, *implementation_, options); });
}

std::string Image::encode(std::string_view ending, const ImageFileOptions& options) const {
    return api::guarded([&] { return api::encode_image(ending, *implementation_, options); });
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
        attributes.erase("noise");  // the noise of the first part alone
        attributes[api::kFrameHash] = hash;
        const Image image = api::handle_of(
            std::make_shared<const voxelume::Image>(std::move(whole)), std::move(attributes));
        for (const std::filesystem::path& file : files) image.write(file, options);
    });
}

}  // namespace v1
}  // namespace voxelume
