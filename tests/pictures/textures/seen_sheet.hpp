// SPDX-License-Identifier: Apache-2.0
// A textured rectangle of 8 x 6 m in the plane y = 0 of its object, computed from 256 exact
// bilinear values per pixel.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <optional>
#include <random>

#include "runtime/scene/scene.hpp"
#include "tests/pictures/textures/texture_image.hpp"

namespace voxelume {

inline constexpr int kEach = 16;  // values of the oracle in each direction of a pixel

/// A picture of large and small patterns with sharp edges, in three different channels.
inline oracle::Picture picture_of(int width, int height) {
    std::mt19937 random(5);
    std::uniform_int_distribution<int> grain(-24, 24);
    oracle::Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool is_light = (x / 12 + y / 9) % 2 == 1;
            const double wave = 60 * std::sin(0.05 * x + 0.11 * y);
            const auto code = [&](double base) {
                return uint8_t(std::clamp(base + wave + grain(random), 0.0, 255.0));
            };
            picture.texels.push_back({code(is_light ? 180 : 70), code(120), code(x % 90 + 60)});
        }
    return picture;
}

/// The ray of a part of a pixel, computed from the scene's values: its direction and, for boxes,
/// its start.
struct SheetRay {
    glm::dvec3 from, way;
};

inline SheetRay sheet_ray(const Scene& scene, double column, double row) {
    const Observer& o = scene.observer;
    const glm::dvec2 half = half_extent(o.display);
    const glm::dvec2 part = 2.0 * glm::dvec2(column, row) / glm::dvec2(scene.render.size) - 1.0;
    const glm::dvec2 at = -part * half;  // rows run down, and X_E points to the left
    const glm::dmat3& axes = o.world_from_observer;
    if (o.display.shape == DisplayShape::box)
        return {o.position + axes[0] * at.x + axes[1] * at.y, axes[2]};
    return {o.position, axes * glm::dvec3(at, 1)};
}

/// The colour that the sheet shows along a ray. It is negative outside the sheet, or closer than
/// `margin` to its border.
inline glm::dvec3 color_along(const oracle::Picture& picture, const glm::dmat4& object_from_world,
                              const SheetRay& ray, double margin = 0) {
    const glm::dvec3 from(object_from_world * glm::dvec4(ray.from, 1));
    const glm::dvec3 way(object_from_world * glm::dvec4(ray.way, 0));
    const glm::dvec3 at = from - way * (from.y / way.y);
    if (from.y / way.y > 0 || std::abs(at.x) > 4 - margin || std::abs(at.z) > 3 - margin)
        return glm::dvec3(-1);
    return oracle::bilinear(picture, {(at.x + 4) / 8 * 3, 1 - (at.z + 3) / 6 * 2});
}

/// The root mean square of the differences from the oracle, in 1/255, over the pixels that see
/// nothing but the sheet. With `mirror`, the sheet is seen in a mirror at this z.
struct Difference {
    double squares = 0, largest = 0;
    size_t pixels = 0;
    double codes() const { return 255 * std::sqrt(squares / double(3 * pixels)); }
};

inline Difference compare(const Image& image, const Scene& scene, const oracle::Picture& picture,
                          std::optional<double> mirror = {}, double margin = 0) {
    const glm::dmat4 inverse = glm::inverse(scene.objects[0].world_from_object);
    Difference difference;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const size_t pixel = size_t(row) * size_t(image.width) + size_t(column);
            glm::dvec3 sum(0);
            bool is_inside = true;
            for (int i = 0; i < kEach * kEach && is_inside; ++i) {
                const int part_x = i % kEach, part_y = i / kEach;
                SheetRay ray =
                    sheet_ray(scene, column + (part_x + 0.5) / kEach, row + (part_y + 0.5) / kEach);
                if (mirror) {
                    const bool sees_sheet = color_along(picture, inverse, ray).x >= 0;
                    ray.from.z = 2 * *mirror - ray.from.z;
                    ray.way.z = -ray.way.z;
                    is_inside = !sees_sheet;
                }
                const glm::dvec3 color = color_along(picture, inverse, ray, margin);
                is_inside = is_inside && color.x >= 0;
                sum += color / double(kEach * kEach);
            }
            if (!is_inside) continue;
            const glm::dvec3 seen(image.planes.at("R")[pixel], image.planes.at("G")[pixel],
                                  image.planes.at("B")[pixel]);
            difference.squares += glm::dot(seen - sum, seen - sum);
            difference.largest = std::max(difference.largest, glm::length(seen - sum));
            ++difference.pixels;
        }
    return difference;
}

}  // namespace voxelume
