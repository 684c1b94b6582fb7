// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/join_images.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

glm::ivec2 frame_of(const Image& image) {
    return image.frame.x > 0 ? image.frame : glm::ivec2(image.width, image.height);
}

template <class Planes>
bool has_same_names(const Planes& a, const Planes& b) {
    return std::ranges::equal(
        a, b, {}, [](const auto& plane) { return plane.first; },
        [](const auto& plane) { return plane.first; });
}

void check_likeness(const Image& first, const Image& other) {
    if (frame_of(first) != frame_of(other) || first.first.x != other.first.x ||
        first.width != other.width)
        throw Error(ErrorKind::input, "parts of different pictures, or of different columns");
    if (!has_same_names(first.planes, other.planes) ||
        !has_same_names(first.id_planes, other.id_planes))
        throw Error(ErrorKind::input, "parts that have different channels");
}

void check_rows(std::span<const Image> parts) {
    for (size_t i = 1; i < parts.size(); ++i) {
        const int end = parts[i - 1].first.y + parts[i - 1].height, next = parts[i].first.y;
        if (next < end) throw Error(ErrorKind::input, "two parts have row {}", next);
        if (next > end) throw Error(ErrorKind::input, "no part has row {}", end);
    }
}

/// The planes of all parts, each after the one above it.
template <class Value>
void join(std::span<const Image> parts, std::map<std::string, Plane<Value>> Image::*planes,
          Image& image) {
    for (const auto& [name, plane] : parts.front().*planes) {
        std::vector<Value> values;
        values.reserve(size_t(image.width) * size_t(image.height));
        for (const Image& part : parts) {
            const Plane<Value>& more = (part.*planes).at(name);
            values.insert(values.end(), more.begin(), more.end());
        }
        (image.*planes)[name] = std::move(values);
    }
}

}  // namespace

Image join_images(std::vector<Image> parts) {
    if (parts.empty()) throw Error(ErrorKind::input, "no part of a picture");
    const std::map<std::string, std::string> attributes = parts.front().attributes;
    std::ranges::sort(parts, {}, [](const Image& part) { return part.first.y; });
    for (const Image& part : parts) check_likeness(parts.front(), part);
    check_rows(parts);
    const glm::ivec2 frame = frame_of(parts.front());
    Image image;
    image.width = parts.front().width;
    for (const Image& part : parts) image.height += part.height;
    join(parts, &Image::planes, image);
    join(parts, &Image::id_planes, image);
    image.first = parts.front().first;
    image.attributes = attributes;
    const bool is_whole =
        image.first == glm::ivec2(0) && image.width == frame.x && image.height == frame.y;
    image.frame = is_whole ? glm::ivec2(0) : frame;
    return image;
}

namespace {

/// Copies the planes of a view to columns and rows from `first` on.
template <class Value>
void place(const Image& view, std::map<std::string, Plane<Value>> Image::*planes,
           const glm::ivec2& first, Image& quilt) {
    for (const auto& [name, plane] : view.*planes) {
        Plane<Value>& whole = (quilt.*planes)[name];
        if (whole.empty()) whole = std::vector<Value>(size_t(quilt.width) * size_t(quilt.height));
        for (int row = 0; row < view.height; ++row)
            std::copy_n(plane.begin() + ptrdiff_t(row) * view.width, view.width,
                        whole.begin() + ptrdiff_t(first.y + row) * quilt.width + first.x);
    }
}

}  // namespace

void place_view(const Image& view, int number, const glm::ivec2& columns_and_rows, Image& quilt) {
    const auto [columns, rows] = std::pair(columns_and_rows.x, columns_and_rows.y);
    if (quilt.width == 0) {
        quilt.width = view.width * columns;
        quilt.height = view.height * rows;
        quilt.attributes = view.attributes;
    }
    const glm::ivec2 first(number % columns * view.width,
                           (rows - 1 - number / columns) * view.height);
    place(view, &Image::planes, first, quilt);
    place(view, &Image::id_planes, first, quilt);
}

}  // namespace voxelume
