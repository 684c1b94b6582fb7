// SPDX-License-Identifier: Apache-2.0
// Differences of images for callers: as numbers, and as pictures.
#include "runtime/image/image_difference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/image/flip.hpp"
#include "runtime/io/mesh/mesh_color.hpp"
#include "runtime/voxelume/image.hpp"

namespace voxelume {
namespace {

constexpr const char* kColors[] = {"R", "G", "B"};

/// Turns codes into the light that they stand for.
void make_linear(Image& image) {
    for (const char* name : kColors)
        if (const auto plane = image.planes.find(name); plane != image.planes.end())
            for (float& value : plane->second) value = linear_from_srgb(double(value));
}

bool has_colors(const Image& image) {
    return std::ranges::all_of(kColors,
                               [&](const char* name) { return image.planes.contains(name); });
}

/// True if its colours are numbers, infinite ones among them.
bool has_numbers(const Image& image) {
    const auto is_nan = [](float value) { return std::isnan(value); };
    return std::ranges::all_of(kColors, [&](const char* name) {
        return std::ranges::none_of(image.planes.at(name), is_nan);
    });
}

/// The bytes per pixel that are stored while FLIP is computed, and for how many pixels it is: 8K's
/// 7,680 x 4,320 fit. A small file can stand for more, and would take tens of gigabytes.
constexpr double kFlipBytes = 200;
constexpr double kFlipPixels = 1 << 25;

bool has_room_for_flip(const Image& image) {
    const double pixels = double(image.width) * image.height;
    return pixels <= kFlipPixels && has_room_for(kFlipBytes * pixels);
}

/// The colours of an image alone.
Image colors_of(const Image& image, bool are_codes) {
    Image colors{image.width, image.height, {}, {}, {}};
    for (const char* const name : kColors) colors.planes[name] = image.planes.at(name);
    if (are_codes) make_linear(colors);
    return colors;
}

/// The FLIP value of each pixel; empty without colours, for colours that aren't numbers, and where
/// memory has no room for it.
std::optional<std::vector<float>> flip_of(const Image& a, const Image& b, bool are_codes) {
    if (!has_colors(a) || !has_colors(b) || !has_numbers(a) || !has_numbers(b)) return {};
    if (!has_room_for_flip(a)) return {};
    return flip_map(colors_of(a, are_codes), colors_of(b, are_codes));
}

/// True if the options ask for all colours, so that FLIP is among what is compared.
bool wants_flip(const CompareOptions& options) {
    const std::vector<std::string>& names = options.channels;
    return names.empty() || std::ranges::all_of(kColors, [&](const char* color) {
               return std::ranges::find(names, color) != names.end();
           });
}

v1::ImageDifference difference_for_callers(const ImageDifference& difference) {
    v1::ImageDifference result;
    for (const ChannelDifference& c : difference.channels)
        result.channels.push_back({c.channel, c.largest, c.rmse, c.mae, c.mrse, c.differing,
                                   c.unmatched, c.above, c.is_id});
    result.only_in_a = difference.only_in_a;
    result.only_in_b = difference.only_in_b;
    result.pixels = difference.pixels;
    result.above = difference.above;
    return result;
}

/// The pixels of a picture that an image shows, for messages.
std::string place_of(const Image& image) {
    const glm::ivec2 whole =
        image.frame.x > 0 ? image.frame : glm::ivec2(image.width, image.height);
    return fmt::format("begins at {},{} of {} x {} pixels", image.first.x, image.first.y, whole.x,
                       whole.y);
}

void check_pair(const v1::Image& a, const v1::Image& b) {
    const Image &first = api::inside(a), &second = api::inside(b);
    if (a.holds_codes() != b.holds_codes())
        throw Error(ErrorKind::usage, "one image holds the codes of a PNG, the other light");
    if (first.width != second.width || first.height != second.height)
        throw Error(ErrorKind::render, "one image has {} x {} pixels and the other {} x {}",
                    first.width, first.height, second.width, second.height);
    if (place_of(first) != place_of(second))
        throw Error(ErrorKind::render, "one image {}, and the other {}", place_of(first),
                    place_of(second));
}

/// Light that a display shows as heat: black, red, yellow and white at thirds of 0..1.
std::array<float, 3> heat_of(float value) {
    const auto ramp = [value](float from) {
        return linear_from_srgb(double(std::clamp(3 * value - from, 0.0f, 1.0f)));
    };
    return {ramp(0), ramp(1), ramp(2)};
}

v1::Image handle_of(Image image) {
    return api::handle_of(std::make_shared<const Image>(std::move(image)));
}

}  // namespace

namespace v1 {

ImageDifference compare(const Image& a, const Image& b, const CompareOptions& options) {
    return api::guarded([&] {
        check_pair(a, b);
        const voxelume::Image &first = api::inside(a), &second = api::inside(b);
        const voxelume::CompareOptions own{options.channels, options.threshold};
        ImageDifference result = difference_for_callers(compare_images(first, second, own));
        if (!wants_flip(own)) return result;
        if (const auto map = flip_of(first, second, a.holds_codes())) {
            double sum = 0;
            for (const float value : *map) sum += double(value);
            result.flip = map->empty() ? 0 : sum / double(map->size());
        }
        return result;
    });
}

Image difference_image(const Image& a, const Image& b, const CompareOptions& options) {
    return api::guarded([&] {
        check_pair(a, b);
        voxelume::Image image = voxelume::difference_image(api::inside(a), api::inside(b),
                                                           {options.channels, options.threshold});
        if (a.holds_codes()) make_linear(image);
        return handle_of(std::move(image));
    });
}

Image flip_image(const Image& a, const Image& b) {
    return api::guarded([&] {
        check_pair(a, b);
        const voxelume::Image &first = api::inside(a), &second = api::inside(b);
        const bool has_room = has_room_for_flip(first);
        const auto map = flip_of(first, second, a.holds_codes());
        if (!map && has_colors(first) && has_colors(second))
            throw voxelume::Error(
                voxelume::ErrorKind::render, "FLIP can't be told: {}",
                has_room
                    ? "some pixels' colours aren't numbers"
                    : "it takes images of up to 2^25 pixels, and 200 bytes of memory for each");
        if (!map)
            throw voxelume::Error(voxelume::ErrorKind::usage,
                                  "FLIP compares colours, and an image has no R, G and B");
        voxelume::Image image{first.width, first.height, {}, {}, {}, first.first, first.frame};
        std::array<std::vector<float>, 3> heat;
        for (const float value : *map)
            for (size_t channel = 0; channel < 3; ++channel)
                heat[channel].push_back(heat_of(value)[channel]);
        image.planes["FLIP"] = *map;
        for (size_t channel = 0; channel < 3; ++channel)
            image.planes[kColors[channel]] = std::move(heat[channel]);
        return handle_of(std::move(image));
    });
}

}  // namespace v1
}  // namespace voxelume
