// SPDX-License-Identifier: Apache-2.0
// An object that goes and comes back as the only one of its model and kind: only its own bricks are
// painted, and the results of its model still exist if they are retained.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "runtime/analysis/model_last_uses.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

// Bricks are 0.8 m. The object `thing` stands where eight of them meet, the objects that stay stand
// elsewhere.
constexpr const char* kRetainedScene = R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-3.2, -0.8, -3.2], "max": [3.2, 0.8, 3.2]}},
          "ambient": [0.1, 0.2, 0.3]}},
"materials": {{"red": {{"color": [0.8, 0.2, 0.2]}}, "blue": {{"color": [0.2, 0.2, 0.8]}}}},
"models": {{"ball": {{"shape": "sphere", "radius": 0.3, "surface": "{1}"}}, "thing": {{{0}}}}},
"objects": [{2}
  {{"name": "thing", "model": "thing", "material": "blue", "placement": "{3}",
   "position": [-0.8, 0, -0.8]}}],
"lights": [{{"type": "point", "position": [1, 3, -3], "intensity": 20}}],
"observer": {{"position": [0, 1.5, -5], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angle": 50}}}},
"render": {{"size": [64, 48]}},
"animation": {{"frames": 4, "tracks": [{{"target": "objects.thing.visible",
    "keys": [{{"frame": 1, "value": true}}, {{"frame": 2, "value": false}},
             {{"frame": 3, "value": true}}, {{"frame": 4, "value": false}}]}}]}}}})";

constexpr const char* kStayer =
    R"({"name": "ball", "model": "ball", "material": "red", "position": [1.6, 0, 1.6]},)";

/// The object that comes and goes, the one that stays, and how they are placed.
struct Toggled {
    const char* name;
    const char* thing;
    const char* stayer_surface = "smooth";
    const char* stayer = kStayer;
    const char* placement = "world";
};

/// Prints the case in the name of a test.
void PrintTo(const Toggled& toggled, std::ostream* out) {
    *out << toggled.name;
}

class Retained : public FileTest, public testing::WithParamInterface<Toggled> {
  protected:
    Scene scene() {
        put_bytes(folder / "gem.obj",
                  "v 0.2 0 0 1 0 0\nv -0.25 0 0 0 1 0\nv 0 0.3 0 0 0 1\nv 0 -0.15 0 1 1 0\n"
                  "v 0 0 0.22 0 1 1\nv 0 0 -0.18 1 0 1\n"
                  "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n");
        const Toggled& toggled = GetParam();
        return parse_scene(fmt::format(kRetainedScene, toggled.thing, toggled.stayer_surface,
                                       toggled.stayer, toggled.placement),
                           folder / "scene.json", {});
    }

    /// The reports of frames 1 to 4; expects that each frame looks as it does when it is rendered
    /// alone.
    std::vector<WorldReport> frames(const std::vector<bool>& retained) {
        const Scene moving = scene();
        WorldBuilder builder(shared_device());
        Renderer renderer(shared_device());
        std::vector<WorldReport> reports;
        for (const int frame : {1, 2, 3, 4}) {
            const Scene now = scene_at(moving, frame);
            RenderReport report, alone;
            const BuiltWorld world = builder.build(now, report.world, retained);
            EXPECT_EQ(oracle::image_hash(*renderer.image(now, world, report)),
                      oracle::image_hash(render(shared_device(), now, alone)))
                << "frame " << frame;
            reports.push_back(report.world);
        }
        return reports;
    }
};

TEST_P(Retained, ComesBackForTheCostOfItsOwnBricks) {
    const std::vector<WorldReport> reports = frames({true, true});
    const bool is_instance = GetParam().placement == std::string("instance");
    for (const int frame : {2, 4}) {
        EXPECT_EQ(reports[frame - 1].painted_bricks, 0u) << frame;
        EXPECT_EQ(reports[frame - 1].voxelized, 0u) << frame;
    }
    EXPECT_EQ(reports[2].voxelized, 0u);
    EXPECT_EQ(reports[2].meshes_read, 0u);
    EXPECT_EQ(reports[2].painted_bricks, is_instance ? 0u : 8u);
    EXPECT_EQ(reports[2].instances.indexed, 0u);
}

TEST_P(Retained, IsForgottenWhereNoFrameShowsItAgain) {
    const std::vector<WorldReport> reports = frames({true, false});
    EXPECT_EQ(reports[2].voxelized, 1u);
    EXPECT_EQ(reports[2].painted_bricks, GetParam().placement == std::string("world") ? 8u : 0u);
}

TEST_P(Retained, IsKnownFromTheFramesOfARun) {
    const Scene moving = scene();
    const size_t stays = *GetParam().stayer ? 4 : 0;
    EXPECT_EQ(last_uses(moving, std::vector<int>{1, 2, 3, 4}), (std::vector<size_t>{stays, 3}));
    EXPECT_EQ(last_uses(moving, std::vector<int>{2, 4, 2, 4})[1], 0u);
    EXPECT_EQ(last_uses(moving, std::vector<int>{4, 3, 2, 1})[1], 4u);
}

constexpr const char* kMesh = R"("mesh": "gem.obj", "voxel_size": 0.05, "surface": "smooth")";

INSTANTIATE_TEST_SUITE_P(
    Things, Retained,
    testing::Values(
        Toggled{"Smooth", R"("shape": "sphere", "radius": 0.2)"},
        Toggled{"SmoothBesideCubes", R"("shape": "sphere", "radius": 0.2)", "cubes"},
        Toggled{"SmoothBesideExact", R"("shape": "sphere", "radius": 0.2)", "exact"},
        Toggled{"Cubes", R"("shape": "box", "size": [0.4, 0.3, 0.2], "surface": "cubes")"},
        Toggled{"Exact", R"("shape": "sphere", "radius": 0.2, "surface": "exact")"},
        Toggled{"ExactBesideCubes", R"("shape": "sphere", "radius": 0.2, "surface": "exact")",
                "cubes"},
        Toggled{"ExactBesideExact", R"("shape": "sphere", "radius": 0.2, "surface": "exact")",
                "exact"},
        Toggled{"ColoredMesh", kMesh}, Toggled{"ColoredMeshBesideCubes", kMesh, "cubes"},
        Toggled{"OnlyObject", R"("shape": "sphere", "radius": 0.2)", "smooth", ""},
        Toggled{"OnlyObjectOfAColoredMesh", kMesh, "smooth", ""},
        Toggled{"Instance", R"("shape": "sphere", "radius": 0.2)", "smooth", kStayer, "instance"},
        Toggled{"InstanceOfAMesh", kMesh, "cubes", kStayer, "instance"}),
    [](const auto& toggled) { return std::string(toggled.param.name); });

}  // namespace
}  // namespace voxelume
