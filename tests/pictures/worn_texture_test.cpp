// SPDX-License-Identifier: Apache-2.0
// Textures of exact triangles where rays meet them, against 256 exact bilinear values a pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <optional>
#include <random>

#include "runtime/io/image/png.hpp"
#include "tests/pictures/texture_image.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/instance_scenes.hpp"

namespace voxelume {
namespace {

constexpr int kEach = 16;  // values of the oracle in each direction of a pixel

/// A picture with large and small patterns and sharp edges, of three different channels.
oracle::Picture picture_of(int width, int height) {
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

/// A rectangle of 8 x 6 m in the plane y = 0, with places on a texture from 0 to 3 and to 2.
class WornTexture : public FileTest {
  protected:
    void write(const oracle::Picture& picture) const {
        put_bytes(folder / "sheet.obj",
                  "mtllib sheet.mtl\nv -4 0 -3\nv 4 0 -3\nv 4 0 3\nv -4 0 3\nvt 0 0\nvt 3 0\n"
                  "vt 3 2\nvt 0 2\nusemtl m\nf 1/1 4/4 3/3\nf 1/1 3/3 2/2\n");
        put_bytes(folder / "sheet.mtl", "newmtl m\nmap_Kd sheet.png\n");
        write_png(folder / "sheet.png", image_of(picture));
    }

    Scene scene_of(const std::string& placement, const std::string& map, const std::string& display,
                   int samples, const std::string& more = "") const {
        return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.1, "bounds": {{"min": [-6, -4, -6], "max": [6, 4, 6]}},
          "ambient": [1, 1, 1]}},
"materials": {{"default": {{"color": [1, 1, 1], "diffuse": 1}},
              "mirror": {{"diffuse": 0, "reflection": 1}}}},
"models": {{"sheet": {{"mesh": "sheet.obj", "surface": "exact", "voxel_size": 0.1}},
           "wall": {{"shape": "box", "size": [11, 7.5, 0.1], "surface": "exact"}}}},
"objects": [{{"model": "sheet", "placement": "{}", {}}} {}], "lights": [],
"observer": {{"position": [0.4, 0.9, -3.4], "look_at": [0, 0, 0.3],
             "display": {{{}}}}},
"render": {{"size": [64, 48], "samples": {}, "depth": 1}}}})",
                                       placement, map, more, display, samples),
                           folder / "scene.json", {});
    }
};

/// Where a pixel's part looks, by the scene's own words: the way, and for boxes the start.
struct Sight {
    glm::dvec3 from, way;
};

Sight sight_of(const Scene& scene, double column, double row) {
    const Observer& o = scene.observer;
    const glm::dvec2 half = half_extent(o.display);
    const glm::dvec2 part = 2.0 * glm::dvec2(column, row) / glm::dvec2(scene.render.size) - 1.0;
    const glm::dvec2 at = -part * half;  // rows run down, and X_E points to the left
    const glm::dmat3& axes = o.world_from_observer;
    if (o.display.shape == DisplayShape::box)
        return {o.position + axes[0] * at.x + axes[1] * at.y, axes[2]};
    return {o.position, axes * glm::dvec3(at, 1)};
}

/// The colour that the sheet shows along a ray; negative beside it.
glm::dvec3 color_along(const oracle::Picture& picture, const glm::dmat4& object_from_world,
                       const Sight& sight) {
    const glm::dvec3 from(object_from_world * glm::dvec4(sight.from, 1));
    const glm::dvec3 way(object_from_world * glm::dvec4(sight.way, 0));
    const glm::dvec3 at = from - way * (from.y / way.y);
    if (from.y / way.y > 0 || std::abs(at.x) > 4 || std::abs(at.z) > 3) return glm::dvec3(-1);
    return oracle::bilinear(picture, {(at.x + 4) / 8 * 3, 1 - (at.z + 3) / 6 * 2});
}

/// The root of the mean square of the differences from the oracle, in 1/255, of the pixels that see
/// nothing but the sheet. With `mirror` the sheet is seen in a mirror at this z.
struct Difference {
    double squares = 0, largest = 0;
    size_t pixels = 0;
    double codes() const { return 255 * std::sqrt(squares / double(3 * pixels)); }
};

Difference compare(const Image& image, const Scene& scene, const oracle::Picture& picture,
                   std::optional<double> mirror = {}) {
    const glm::dmat4 inverse = glm::inverse(scene.objects[0].world_from_object);
    Difference difference;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const size_t pixel = size_t(row) * size_t(image.width) + size_t(column);
            glm::dvec3 sum(0);
            bool is_inside = true;
            for (int i = 0; i < kEach * kEach && is_inside; ++i) {
                const int part_x = i % kEach, part_y = i / kEach;
                Sight sight =
                    sight_of(scene, column + (part_x + 0.5) / kEach, row + (part_y + 0.5) / kEach);
                if (mirror) {
                    const bool sees_sheet = color_along(picture, inverse, sight).x >= 0;
                    sight.from.z = 2 * *mirror - sight.from.z;
                    sight.way.z = -sight.way.z;
                    is_inside = !sees_sheet;
                }
                const glm::dvec3 color = color_along(picture, inverse, sight);
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

constexpr const char* kPyramid =
    R"("shape": "pyramid", "angles": [60, 44], "near": 0.01, "far": 50)";

TEST_F(WornTexture, IsTheMeanOverAPixelUnderAnyMapInTheWorldAndAsInstances) {
    const oracle::Picture picture = picture_of(256, 160);
    write(picture);
    for (const char* placement : {"world", "instance"})
        for (const char* map :
             {R"("position": [0, 0, 0])", R"("position": [0, -0.2, 0.3], "turn": [4, 21, -6])",
              R"("scale": [-1, 1, 1])",
              R"("matrix": [[1, 0.4, 0.2, 0], [0, 1, -0.1, 0], [0.2, 0, 1.2, 0.5]])"})
            for (const int samples : {1, 4}) {
                const Scene scene = scene_of(placement, map, kPyramid, samples);
                const Difference d = compare(image_of_scene(scene), scene, picture);
                EXPECT_GT(d.pixels, 700u) << placement << map;
                EXPECT_LT(d.codes(), 1) << placement << map << samples << " " << d.largest;
            }
}

TEST_F(WornTexture, IsBlurredByWhatParallelAndAngularPixelsSpan) {
    const oracle::Picture picture = picture_of(256, 160);
    write(picture);
    const Scene box =
        scene_of("world", R"("turn": [5, 20, 0])", R"("shape": "box", "size": [3, 2.2, 12])", 1);
    EXPECT_LT(compare(image_of_scene(box), box, picture).codes(), 1);
}

TEST_F(WornTexture, InAMirrorIsBlurredByTheWholeWay) {
    const oracle::Picture picture = picture_of(128, 80);
    write(picture);
    const Scene scene =
        scene_of("world", R"("position": [0, -0.6, -1])", kPyramid, 1,
                 R"(, {"model": "wall", "material": "mirror", "position": [0, 0, 3.05]})");
    const Difference d = compare(image_of_scene(scene), scene, picture, 3.0);
    EXPECT_GT(d.pixels, 50u);
    EXPECT_LT(d.codes(), 3) << d.largest << " " << d.pixels;
}

TEST_F(WornTexture, OfOneTexelLooksLikeAMaterialOfItsColor) {
    oracle::Picture picture{1, 1, {{200, 100, 50}}};
    write(picture);
    const Scene scene = scene_of("world", R"("position": [0, 0, 0])", kPyramid, 2);
    EXPECT_LT(compare(image_of_scene(scene), scene, picture).largest, 1e-6);
}

}  // namespace
}  // namespace voxelume
