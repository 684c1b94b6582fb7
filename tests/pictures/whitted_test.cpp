// SPDX-License-Identifier: Apache-2.0
// The picture of Whitted 1980 against an analytic tracer in double precision.
#include <filesystem>

#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/analytic_comparison.hpp"
#include "tests/support/solid_cases.hpp"

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

TEST(Whitted, ThePictureIsTheAnalyticOneBesideEdges) {
    expect_analytic_image(whitted(), 1e-4, 1e-2);
}

TEST(Whitted, SmoothSurfacesGiveTheAnalyticPictureNearly) {
    expect_image(smooth_whitted(), oracle::analytic_image(whitted()), 2e-3, 0.05);
}

}  // namespace
}  // namespace voxelume
