// SPDX-License-Identifier: Apache-2.0
// Pictures of an exact mesh of slivers: a closed pipe, as CAD programs write it, none of whose
// points shades another, compared with the cylinder that it approximates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/analysis/scene_choices.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/finned_ball.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

class SliverImage : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        write_obj(folder / "pipe.obj",
                  turned_outline({{0, -0.25}, {0.25, -0.25}, {0.25, 0.25}, {0, 0.25}}, 4000));
    }

    Image picture(const char* model, const char* placement, const char* material) const {
        AssetStore files;
        Scene scene = parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.1, "bounds": {{"min": [-0.8, -0.8, -0.8], "max": [0.8, 0.8, 0.8]}},
          "background": [1, 1, 1]}},
"models": {{"pipe": {{{}}}}},
"materials": {{"paint": {{{}}}}},
"objects": [{{"model": "pipe", "material": "paint", "turn": [14, 35, 5],
             "placement": "{}"}}],
"lights": [{{"type": "point", "position": [1.5, 1.6, 1.2], "intensity": 4}}],
"observer": {{"position": [0.7, 1, 1.9], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angle": 24}}}},
"render": {{"size": [320, 240]}}}})",
                                              model, material, placement),
                                  folder / "pipe.json", {}, [&](const Model& read, bool keeps) {
                                      return files.box_of_file(read, keeps);
                                  });
        AssetStore meshes;
        make_choices(scene, meshes);
        scene.render.channels.depth = scene.render.channels.object = true;
        RenderReport report;
        return render(shared_device(), scene, report);
    }
};

constexpr const char* kPipe = R"("mesh": "pipe.obj", "surface": "exact")";
constexpr const char* kCylinder = R"("shape": "cylinder", "radius": 0.25, "height": 0.5)";

/// The pixels that show the object in both images, and not its outline.
std::vector<size_t> inner_pixels(const Image& a, const Image& b) {
    std::vector<size_t> pixels;
    const auto& ours = a.id_planes.at("objectId");
    const auto& theirs = b.id_planes.at("objectId");
    const auto width = size_t(a.width);
    for (size_t pixel = width + 1; pixel + width + 1 < ours.size(); ++pixel) {
        const auto is_inner = [&](size_t at) { return ours[at] != 0 && theirs[at] != 0; };
        if (is_inner(pixel - 1) && is_inner(pixel + 1) && is_inner(pixel - width) &&
            is_inner(pixel + width))
            pixels.push_back(pixel);
    }
    return pixels;
}

// The facets differ by 0.09 degrees from each other. The largest differences were 1.7e-6 m, a
// fifty-thousandth of a voxel, and 2.1e-4.
TEST_F(SliverImage, LiesWhereTheCylinderDoesAndIsLitLikeIt) {
    const char* const matt = R"("color": [0.5, 0.5, 0.5])";
    const Image truth = picture(kCylinder, "world", matt);
    for (const char* const placement : {"world", "instance"}) {
        const Image image = picture(kPipe, placement, matt);
        const std::vector<size_t> pixels = inner_pixels(image, truth);
        ASSERT_GT(pixels.size(), 10000u);
        double depth = 0, light = 0;
        for (const size_t pixel : pixels) {
            depth = std::max(depth, std::abs(double(image.planes.at("Z")[pixel]) -
                                             double(truth.planes.at("Z")[pixel])));
            light = std::max(light, std::abs(double(image.planes.at("R")[pixel]) -
                                             double(truth.planes.at("R")[pixel])));
        }
        EXPECT_LT(depth, 4e-6) << placement;
        EXPECT_LT(light, 0.001) << placement;
    }
}

// A ray that met a neighbour, too, would bring less than half of the background.
TEST_F(SliverImage, MirrorsNothingButTheBackground) {
    const char* const mirror = R"("color": [0, 0, 0], "diffuse": 0, "reflection": 0.5)";
    for (const char* const placement : {"world", "instance"}) {
        const Image image = picture(kPipe, placement, mirror);
        const std::vector<size_t> pixels = inner_pixels(image, image);
        ASSERT_GT(pixels.size(), 10000u);
        for (const size_t pixel : pixels)
            ASSERT_EQ(image.planes.at("R")[pixel], 0.5f) << placement << ", pixel " << pixel;
    }
}

}  // namespace
}  // namespace voxelume
