// SPDX-License-Identifier: Apache-2.0
// The picture of Whitted 1980 against an analytic tracer in double precision.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/analytic_comparison.hpp"
#include "tests/support/solid_cases.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

Scene whitted() {
    Scene scene = read_scene(std::filesystem::path(VXL_SOURCE_DIR) / "scenes/whitted.json", {});
    if (!is_exhaustive()) resize(scene, scene.render.size / 2);
    return scene;
}

/// The Whitted scene with `smooth` surfaces. They form a union where objects overlap, so a
/// difference hollows the glass ball.
Scene smooth_whitted() {
    Scene scene = whitted();
    for (Model& model : scene.models) model.surface = Surface::smooth;
    const auto model_of = [&](const std::string& name) -> Model& {
        for (Model& model : scene.models)
            if (model.name == name) return model;
        throw std::invalid_argument("no model " + name);
    };
    model_of("outside").solid =
        combined(SolidKind::difference_of, {*model_of("outside").solid, *model_of("hollow").solid});
    std::erase_if(scene.objects, [](const Object& object) { return object.name == "hollow"; });
    return scene;
}

/// A ball of metal above a white floor, in white light.
Scene metal_ball(double metallic, double roughness) {
    return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}},
          "background": [0.7, 0.7, 0.7], "ambient": [0.1, 0.1, 0.1]}},
"materials": {{"metal": {{"base_color": [0.8, 0.4, 0.2], "metallic": {}, "roughness": {}}},
              "chalk": {{"color": [1, 1, 1]}}}},
"models": {{"ball": {{"shape": "sphere", "radius": 0.5, "surface": "exact"}},
           "floor": {{"shape": "box", "size": [2, 0.1, 2], "surface": "exact"}}}},
"objects": [{{"model": "ball", "material": "metal"}},
            {{"model": "floor", "material": "chalk", "position": [0, -0.7, 0]}}],
"lights": [{{"type": "point", "position": [0.9, 0.9, -0.9], "intensity": 1.5}}],
"observer": {{"position": [0, 0.4, -2], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angle": 40}}}},
"render": {{"size": [40, 32], "depth": 2}}}})",
                                   metallic, roughness),
                       "metal.json", {});
}

TEST(Whitted, MetalReturnsAllLightInItsColorAndNotMuchMoreThanIsThere) {
    for (const double roughness : {0.0, 0.35, 1.0}) {
        Scene scene = metal_ball(1, roughness);
        scene.render.channels.object = true;
        RenderReport report;
        const Image image = render(test_device(), scene, report);
        size_t pixels = 0;
        float dullest = 1;
        for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
            if (image.id_planes.at("objectId")[i] != 1) continue;
            const float red = image.planes.at("R")[i];
            EXPECT_NEAR(image.planes.at("G")[i], red / 2, 1e-5f) << roughness;
            EXPECT_NEAR(image.planes.at("B")[i], red / 4, 1e-5f) << roughness;
            dullest = std::min(dullest, red);
            ++pixels;
        }
        EXPECT_GT(pixels, 150u);
        EXPECT_GT(dullest, 0.02f) << roughness;  // it isn't black anywhere
    }
}

TEST(Whitted, MetalHasTheSameBitsWithAnyNumberOfLanes) {
    const Scene scene = metal_ball(0.7, 0.3);
    RenderReport report;
    const Image one = render(test_device(1), scene, report);
    for (const int lanes : {4, 8, 16})
        EXPECT_EQ(one.planes, render(test_device(lanes), scene, report).planes) << lanes;
}

TEST(Whitted, ThePictureIsTheAnalyticOneAwayFromEdges) {
    expect_analytic_image(whitted(), 1e-4, 1e-2);
}

TEST(Whitted, SmoothSurfacesGiveTheAnalyticPictureNearly) {
    expect_image(smooth_whitted(), oracle::analytic_image(whitted()), 2e-3, 0.05);
}

}  // namespace
}  // namespace voxelume
