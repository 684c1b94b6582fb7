// SPDX-License-Identifier: Apache-2.0
// What `check` promises of a device's memory against what a run takes at its height: volumetric
// images of built scenes. Each test prints its line of a table.
#include <gtest/gtest.h>

#include "runtime/memory/frame_plans.hpp"
#include "runtime/render/volume_renderer.hpp"
#include "tests/memory/kept_promise.hpp"
#include "tests/support/display_fixture.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// Renders a volumetric image.
void expect_volume_kept(const std::string& name, Scene scene) {
    scene.render.shows_image = false;
    scene.render.shows_volume = true;
    const Device device = test_device();
    AssetStore meshes;
    const double promise = plan_scene(scene, meshes, device.info()).peak_bytes();
    RenderReport report;
    render_volume(device, scene, report);
    expect_kept(name, promise, device, kMaxRatio);
}

TEST(BuiltScene, OfADisplayOfEachShapeAndLayoutTakesWhatIsPromised) {
    size_t turn = 0;
    for (const auto& [name, keys] : kDisplayCases)
        for (const char* layout : in_turn<const char*>({"rays", "lattice"}, turn++)) {
            const std::string display =
                fmt::format(R"({}, "voxels": [96, 72, 64], "layout": "{}")", keys, layout);
            expect_volume_kept(fmt::format("{} {}", name, layout),
                               parsed(display_scene(display, "smooth")));
        }
}

TEST(BuiltScene, OfRaysOfADisplayInAMediumAndThroughVeilsTakesWhatIsPromised) {
    for (const char* ball : {"", R"("opacity": 0.5)"})
        for (const char* medium : {"", R"("medium": {"absorption": [0.3, 0.3, 0.3]},)"}) {
            Scene scene = promise_room(ball, "", medium, 0.04);
            scene.observer.display.voxels = {96, 96, 128};
            expect_volume_kept(fmt::format("rays: {} {}", ball, medium), scene);
        }
}

TEST(BuiltScene, OfALatticeOfGlassInAMediumTakesWhatIsPromised) {
    for (const int samples : {1, 4}) {
        Scene scene = promise_room(R"("refraction": 0.9, "ior": 1.5)", "",
                                   R"("medium": {"absorption": [0.3, 0.3, 0.3]},)", 0.04);
        scene.observer.display.layout = VolumeLayout::lattice;
        scene.observer.display.voxels = {64, 48, 48};
        scene.render.samples = samples;
        expect_volume_kept(fmt::format("glass in a medium, {} samples", samples), scene);
    }
}

TEST(BuiltScene, OfAVolumetricImageInGlobalLightTakesWhatIsPromised) {
    for (const VolumeLayout layout : {VolumeLayout::lattice, VolumeLayout::rays})
        for (const char* ball : {"", R"("refraction": 0.9, "ior": 1.5)", R"("opacity": 0.4)"})
            for (const double noise : {0.0, 0.2}) {
                Scene scene = promise_room(ball, "", "", 0.04);
                scene.observer.display.layout = layout;
                scene.observer.display.voxels = {64, 48, 48};
                scene.render.light = LightMode::global;
                scene.render.noise.error = noise;
                scene.render.samples = noise > 0 ? 32 : 3;
                expect_volume_kept(
                    fmt::format("global light, {}, noise {}: {}",
                                layout == VolumeLayout::rays ? "rays" : "lattice", noise, ball),
                    scene);
            }
}

}  // namespace
}  // namespace voxelume
