// SPDX-License-Identifier: Apache-2.0
// Parts of a display that see nothing are left out of volumetric images, are counted, and show
// nothing.
#include <gtest/gtest.h>

#include "runtime/render/volume_renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

/// A scene of a small ball off the middle of a large display.
constexpr const char* kScene = R"({"voxelume": 1,
"world": {"voxel_size": 0.025, "bounds": {"min": [-2, -2, -2], "max": [2, 2.2, 2.4]}},
"models": {"ball": {"shape": "sphere", "radius": 0.3, "surface": "smooth"}},
"objects": [{"model": "ball", "position": [0.5, 0.6, 0.2]}],
"lights": [{"type": "point", "position": [0.5, 3, -1], "intensity": 9}],
"observer": {"position": [0.2, 0.7, -4], "look_at": [0, 0, 0],
             "display": {"shape": "box", "size": [3, 3, 3], "near": 2.5, "voxels": [VOXELS],
                         "layout": "LAYOUT"}}})";

Scene scene_of(const char* voxels, const char* layout) {
    std::string text = kScene;
    text.replace(text.find("VOXELS"), 6, voxels);
    text.replace(text.find("LAYOUT"), 6, layout);
    return parse_scene(text, "s.json", {});
}

RenderReport report_of(const Scene& scene, Volume& volume) {
    RenderReport report;
    volume = render_volume(shared_device(), scene, report);
    return report;
}

TEST(DisplaySkipping, LinesOfALatticeThatPassAllObjectsByAreNotSent) {
    Scene scene = scene_of("40, 36, 32", "lattice");
    Volume small, large;
    const RenderReport off = report_of(scene, small);
    scene.models[0].solid->radius = 1.4;
    scene.objects[0].world_from_object = glm::dmat4(1);
    const RenderReport amid = report_of(scene, large);
    EXPECT_FALSE(small.indices.empty());
    EXPECT_EQ(off.display_lines + off.clear_display_lines,
              amid.display_lines + amid.clear_display_lines);
    EXPECT_GT(off.clear_display_lines, off.display_lines / 2);
    EXPECT_LT(amid.clear_display_lines, amid.display_lines / 4);
    scene.objects[0].visible = false;
    const RenderReport empty = report_of(scene, large);
    EXPECT_EQ(empty.display_lines, 0u);
    EXPECT_EQ(empty.clear_display_lines, off.display_lines + off.clear_display_lines);
}

/// Opacities are measured on lines through the same voxels, four or more to a voxel's side.
TEST(DisplaySkipping, LinesThatLookForOpacitiesCountToo) {
    Scene scene = scene_of("40, 36, 32", "lattice");
    Volume opaque, sheer;
    const RenderReport once = report_of(scene, opaque);
    scene.materials[0].opacity = 0.5f;
    const RenderReport twice = report_of(scene, sheer);
    EXPECT_GT(twice.display_lines, once.display_lines * 19 / 10);
    EXPECT_GT(twice.clear_display_lines, once.clear_display_lines * 19 / 10);
}

TEST(DisplaySkipping, BeamsEndTilesThatSeeNothingAndChangeNoVoxel) {
    Volume with, without;
    const RenderReport many = report_of(scene_of("256, 256, 24", "rays"), with);
    EXPECT_EQ(many.sight_rays, 65536u);
    EXPECT_EQ(many.beams, 4096u);
    std::vector<bool> is_empty(64 * 64, true);
    for (const uint64_t index : with.indices)
        is_empty[index / 256 % 256 / 4 * 64 + index % 256 / 4] = false;
    const auto empty = uint64_t(std::ranges::count(is_empty, true));
    EXPECT_LT(empty, 4096u);
    EXPECT_LE(many.clear_beams, empty);
    EXPECT_GT(many.clear_beams, empty * 3 / 5);

    // No beams are sent if they might meet an instance next to the display.
    Scene scene = scene_of("256, 256, 24", "rays");
    scene.objects.push_back(scene.objects[0]);
    scene.objects[1].placement = Placement::instance;
    scene.objects[1].world_from_object = glm::dmat4(0.1);
    scene.objects[1].world_from_object[3] = {-1.6, 0.5, 0, 1};
    EXPECT_EQ(report_of(scene, without).beams, 0u);
    EXPECT_EQ(without.indices, with.indices);
    EXPECT_EQ(without.colors, with.colors);
    EXPECT_EQ(without.depths, with.depths);
}

}  // namespace
}  // namespace voxelume
