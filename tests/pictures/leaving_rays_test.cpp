// SPDX-License-Identifier: Apache-2.0
// Rays that begin a little off triangles and instances, in worlds whose rounding is coarse: they
// meet what lies close behind, and end where their light is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/analysis/scene_choices.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

class LeavingRays : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        write_obj(folder / "unit.obj", box(glm::vec3(-0.5f), glm::vec3(0.5f)));
    }

    /// The red channel of a picture of a world, objects and lights.
    std::vector<float> picture(const std::string& text) const {
        AssetStore files;
        Scene scene = parse_scene(R"({"voxelume": 1, "models": {
"mesh": {"mesh": "unit.obj", "surface": "exact"}, "solid": {"shape": "box", "size": [1, 1, 1]}},
"materials": {"matt": {"color": [0.7, 0.7, 0.7]}, "lamp": {"emission": [30, 30, 30]},
  "glass": {"color": [0, 0, 0], "diffuse": 0, "refraction": 0.9, "ior": 1.5}},
"render": {"size": [96, 72], "depth": 6}, )" +
                                      text,
                                  folder / "scene.json", {}, [&](const Model& read, bool keeps) {
                                      return files.box_of_file(read, keeps);
                                  });
        AssetStore meshes;
        make_choices(scene, meshes);
        RenderReport report;
        const Image image = render(shared_device(), scene, report);
        const auto& red = image.planes.at("R");
        return {red.begin(), red.end()};
    }
};

/// The pixels that differ by more than `maximum`.
size_t differing(const std::vector<float>& a, const std::vector<float>& b, float maximum) {
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i) count += std::abs(a[i] - b[i]) > maximum;
    return count;
}

// Voxels of 1 x 20 x 20 mm, 16,000 of them along x: points are right within 1/256 voxel along each
// axis, and rays set out from 35 times as far.
TEST_F(LeavingRays, EndAtTheSurfaceOfTheirLight) {
    const auto lit = [&](const char* model, const char* placement) {
        return picture(fmt::format(R"(
"world": {{"voxel_size": [0.001, 0.02, 0.02],
           "bounds": {{"min": [-8, -0.2, -0.1], "max": [8, 0.2, 0.1]}}}},
"objects": [{{"model": "{}", "material": "matt", "position": [0, -0.1, 0],
              "scale": [0.3, 0.05, 0.18], "placement": "{}"}},
            {{"model": "mesh", "material": "lamp", "position": [0, 0.1, 0],
              "scale": [0.02, 0.02, 0.02], "placement": "world"}}],
"lights": [],
"observer": {{"position": [0, 0.15, 0.6], "look_at": [0, -0.05, 0],
             "display": {{"shape": "pyramid", "angle": 40}}}}}})",
                                   model, placement));
    };
    const std::vector<float> truth = lit("solid", "world");
    EXPECT_GT(*std::ranges::max_element(truth), 0.1f);
    EXPECT_LE(differing(lit("mesh", "world"), truth, 1e-3f), 2u);
    EXPECT_LE(differing(lit("mesh", "instance"), truth, 1e-3f), 2u);
}

// A pane over a table that is thinner than what rays leave other triangles by.
TEST_F(LeavingRays, LeaveAThinPaneOfGlass) {
    const auto seen_through = [&](double thickness) {
        return picture(fmt::format(R"(
"world": {{"voxel_size": 0.02, "bounds": {{"min": [-20, -1, -1], "max": [20, 1, 1]}},
           "background": [0.6, 0.7, 0.9], "ambient": [0.1, 0.1, 0.1]}},
"objects": [{{"model": "mesh", "material": "matt", "position": [0, -0.6, 0],
              "scale": [1.6, 0.2, 1.6], "placement": "world"}},
            {{"model": "mesh", "material": "glass", "position": [0, 0.013, 0],
              "scale": [0.8, {}, 0.8], "placement": "world"}}],
"lights": [{{"type": "point", "position": [-1.5, 3, 2.5], "intensity": 20}}],
"observer": {{"position": [0.9, 1.1, 2.2], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angle": 40}}}}}})",
                                   thickness));
    };
    EXPECT_LE(differing(seen_through(1e-5), seen_through(2e-4), 0.02f), 20u);
}

}  // namespace
}  // namespace voxelume
