// SPDX-License-Identifier: Apache-2.0
// Textures of exact triangles where rays meet them, against 256 exact bilinear values a pixel.
#include <gtest/gtest.h>

#include "runtime/io/image/png.hpp"
#include "tests/pictures/textures/seen_sheet.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/instance_scenes.hpp"

namespace voxelume {
namespace {

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
