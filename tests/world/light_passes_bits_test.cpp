// SPDX-License-Identifier: Apache-2.0
// The cost of the parts of an image's light, their progress, and that their bits equal those of
// scenes with only that part.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "runtime/render/light_passes.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/world/light_passes_fixture.hpp"

namespace voxelume {
namespace {

/// Global light compiles as many kernels again.
std::vector<LightMode> modes() {
    if (!is_exhaustive()) return {LightMode::local};
    return {LightMode::local, LightMode::global};
}

/// Two batches of sight rays, the second of which isn't full.
Scene of_two_batches(Scene scene) {
    scene.render.size = {90, 70};
    scene.render.samples = 11;
    return scene;
}

TEST_F(LightPasses, WithoutThemNoFurtherLightIsTraced) {
    RenderReport bare, with;
    Scene scene = opaque(stage());
    scene.render.channels = kColor;
    render(shared_device(), scene, bare);
    scene.render.channels.albedo = true;
    render(shared_device(), scene, with);
    EXPECT_EQ(bare.sight_rays, with.sight_rays);
    EXPECT_EQ(bare.shadow_rays, with.shadow_rays);
}

TEST_F(LightPasses, SightRaysAreTracedOnceForAllPasses) {
    for (const LightMode mode : modes()) {
        Scene scene = opaque(stage());
        scene.render.light = mode;
        scene.render.bounces = 1;
        scene.render.channels = kColor;
        RenderReport bare, all;
        render(shared_device(), scene, bare);
        ImageChannels& channels = scene.render.channels;
        channels.albedo = channels.direct = channels.indirect = channels.shadow =
            channels.light_groups = true;
        render(shared_device(), scene, all);
        EXPECT_EQ(bare.sight_rays, uint64_t{7} * 5 * 16 * 2);
        EXPECT_EQ(all.sight_rays, bare.sight_rays);
        EXPECT_EQ(all.beams, bare.beams);
    }
}

/// Compares the passes of an image with images of their scenes alone.
void expect_bits_of_scenes(Scene scene, const std::string& what) {
    const auto shown = [](const Scene& image) {
        RenderReport report;
        return render(shared_device(), image, report);
    };
    ImageChannels& channels = scene.render.channels;
    channels = {true, false, false, false, false};
    channels.albedo = channels.direct = channels.light_groups = true;
    const Image image = shown(scene);
    for (const LightPass& pass : light_passes(scene)) {
        const Image alone = shown(pass.scene);
        for (const char* color : {"R", "G", "B"})
            EXPECT_EQ(image.planes.at(pass.name + "." + color), alone.planes.at(color))
                << pass.name << color << what;
    }
}

TEST_F(LightPasses, TheyHaveTheBitsOfScenesThatTraceTheirOwnSightRays) {
    for (const LightMode mode : modes()) {
        Scene scene = stage();
        scene.render.light = mode;
        scene.render.bounces = 1;
        expect_bits_of_scenes(scene, " before the glass");
        expect_bits_of_scenes(of_two_batches(opaque(scene)), " without glass");
        scene.observer.position = {0.5, -0.25, -0.15};
        expect_bits_of_scenes(scene, " in the glass");
    }
}

/// The reports on the work while a scene is rendered, as parts of the whole.
std::vector<double> told(const Scene& scene) {
    std::vector<double> parts;
    RenderReport report;
    render(shared_device(), scene, report,
           [&](uint32_t done, uint32_t total) { parts.push_back(double(done) / total); });
    return parts;
}

TEST_F(LightPasses, ProgressIsThatOfAllOfThem) {
    Scene scene = opaque(stage());
    scene.render.channels = kColor;
    EXPECT_EQ(told(scene), std::vector<double>{1});
    scene.render.channels.albedo = scene.render.channels.shadow = true;
    const std::vector<double> parts = told(scene);  // of tiles, so that they are rounded down
    ASSERT_EQ(parts.size(), 4u);
    for (size_t i = 0; i < parts.size(); ++i)
        EXPECT_NEAR(parts[i], double(i + 1) / 4, 1.0 / 35) << i;
    EXPECT_EQ(parts.back(), 1);
}

TEST_F(LightPasses, ProgressCountsTheSamplesThatATargetOfNoiseMayNeed) {
    Scene scene = opaque(stage());
    scene.render.channels = kColor;
    scene.render.samples = 128;
    scene.render.noise.error = 1e-9;  // most tiles have them all
    std::vector<double> parts = told(scene);
    EXPECT_TRUE(std::ranges::is_sorted(parts));
    EXPECT_NEAR(parts.front(), 16.0 / 128, 1.0 / 35);
    EXPECT_EQ(parts.back(), 1);
    scene.render.noise.error = 1e9;  // none has more than 32
    parts = told(scene);
    EXPECT_NEAR(parts.front(), 16.0 / 128, 1.0 / 35);
    EXPECT_EQ(parts.back(), 1);
}

TEST_F(LightPasses, FramesOfAnAnimationHaveTheBitsOfStills) {
    Renderer renderer(shared_device());
    AssetStore meshes;
    Scene scene = stage();
    ImageChannels& channels = scene.render.channels;
    channels = kColor;
    channels.albedo = channels.shadow = channels.light_groups = true;
    RenderReport report;
    const BuiltWorld world =
        WorldBuilder(shared_device(), false, std::move(meshes)).build(scene, report.world);
    for (const float intensity : {1.0f, 0.5f}) {
        scene.lights[1].intensity = glm::vec3(intensity);
        const Image frame = *renderer.image(scene, world, report);
        EXPECT_EQ(frame.planes, shown(scene, channels).planes);
    }
    EXPECT_TRUE(report.hits_are_kept);
}

}  // namespace
}  // namespace voxelume
