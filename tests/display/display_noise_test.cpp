// SPDX-License-Identifier: Apache-2.0
// Volumetric images take as many samples in each group of sixteen voxels as a target of noise asks
// for.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "runtime/render/volume_samples.hpp"
#include "tests/support/display_fixture.hpp"

namespace voxelume {
namespace {

/// A white floor with a red wall and a ball on it under a lamp, seen from above.
Scene lit_floor(const std::string& layout, const std::string& light = "global") {
    return parsed(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}},
          "sky": {{"kind": "constant", "color": [0.5, 0.5, 0.5]}}}},
"materials": {{"white": {{"color": [0.9, 0.9, 0.9], "diffuse": 1}},
              "red": {{"color": [0.9, 0.1, 0.1], "diffuse": 1}}}},
"models": {{"floor": {{"shape": "box", "size": [1.5, 1.5, 0.2]}},
           "wall": {{"shape": "box", "size": [0.2, 1.5, 0.8]}},
           "ball": {{"shape": "sphere", "radius": 0.25}}}},
"objects": [{{"model": "floor", "material": "white", "position": [0, 0, 0.43]}},
            {{"model": "wall", "material": "red", "position": [0.63, 0, -0.07]}},
            {{"model": "ball", "material": "white", "position": [-0.3, 0, 0.08]}}],
"lights": [{{"type": "disk", "position": [0, 0.3, -0.9], "direction": [0, -0.2, 1],
            "radius": 0.2, "intensity": 4}}],
"observer": {{"position": [0, 0, -0.9], "look_at": [0, 0, 0],
             "display": {{"shape": "box", "size": [1.8, 1.6, 1.7], "voxels": [24, 20, 22],
                         "layout": "{}", "visibility": "observer"}}}},
"render": {{"size": [24, 20], "light": "{}", "samples": 4096}}}})",
                              layout, light));
}

double luminance_of(const glm::vec3& c) {
    return 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z);
}

/// The root mean square of a volume's differences from another one, over the mean of the other's
/// light.
double relative_error(const Volume& volume, const Volume& expected) {
    EXPECT_EQ(volume.indices, expected.indices);
    double squares = 0, sum = 0;
    for (size_t i = 0; i < volume.colors.size() && i < expected.colors.size(); ++i) {
        const double light = luminance_of(expected.colors[i]);
        squares += std::pow(luminance_of(volume.colors[i]) - light, 2);
        sum += light;
    }
    const auto count = double(volume.colors.size());
    return std::sqrt(squares / count) / (sum / count);
}

TEST(DisplayNoise, ReachesItsTargetWithFewerPathsThanEvenSamples) {
    for (const char* layout : {"lattice", "rays"}) {
        Scene scene = lit_floor(layout);
        scene.render.samples = 1024;
        RenderReport even;
        const Volume expected = render_volume(shared_device(), scene, even);
        EXPECT_EQ(even.volume_noise.tiles, 0u);
        std::map<double, RenderReport> reports;
        scene.render.samples = 4096;
        for (const double target : {0.04, 0.01}) {
            scene.render.noise.error = target;
            RenderReport& report = reports[target];
            const Volume volume = render_volume(shared_device(), scene, report);
            const double error = relative_error(volume, expected);
            fmt::print("{} to {}: {:.4f} measured, {:.4f} off, {} rays\n", layout, target,
                       report.volume_noise.mean(), error, report.secondary_rays);
            EXPECT_GT(report.volume_noise.tiles, 20u);
            EXPECT_LE(report.volume_noise.mean(), target);
            // Voxels on rims are met by few samples, and those of a group may be lit unlike.
            EXPECT_LT(error, 1.3 * target);
            EXPECT_EQ(report.noise.tiles, 0u);
        }
        EXPECT_GT(reports[0.01].secondary_rays, 2 * reports[0.04].secondary_rays);
        EXPECT_LT(reports[0.01].secondary_rays, even.secondary_rays);
    }
}

TEST(DisplayNoise, EndsAfterTheFirstSamplesWithoutTime) {
    for (const char* layout : {"lattice", "rays"}) {
        Scene scene = lit_floor(layout);
        scene.render.noise.seconds = 1e-9;
        RenderReport report;
        const Volume volume = render_volume(shared_device(), scene, report);
        EXPECT_EQ(report.volume_noise.tiles, 0u) << "no halves were compared";
        EXPECT_GT(volume.indices.size(), 100u);
        scene.render.noise = {};
        scene.render.samples = kFirstSamples;
        RenderReport fixed;
        EXPECT_LT(relative_error(volume, render_volume(shared_device(), scene, fixed)), 1e-6);
        EXPECT_EQ(report.secondary_rays, fixed.secondary_rays);
    }
}

TEST(DisplayNoise, IsMeasuredInHalfOfTheTimeNextToAnImage) {
    RenderSettings render;
    EXPECT_EQ(time_share(render), 1);
    render.shows_volume = true;
    EXPECT_EQ(time_share(render), 0.5);
    render.shows_image = false;
    EXPECT_EQ(time_share(render), 1);
}

TEST(DisplayNoise, OfLocalLightIsMeasuredWhereItHasSamples) {
    Scene scene = lit_floor("lattice", "local");
    scene.world.sky.reset();
    scene.render.noise.error = 0.05;
    RenderReport report;
    const Volume volume = render_volume(shared_device(), scene, report);
    EXPECT_GT(report.volume_noise.tiles, 20u);
    EXPECT_LE(report.volume_noise.mean(), 0.05);
    scene.render.noise = {};
    scene.render.samples = 256;
    // The reference has the noise of 256 samples itself.
    EXPECT_LT(relative_error(volume, volume_of(scene)), 0.1);
    scene = lit_floor("rays", "local");
    scene.render.noise.error = 0.05;
    RenderReport of_rays;
    render_volume(shared_device(), scene, of_rays);
    EXPECT_EQ(of_rays.volume_noise.tiles, 0u) << "one ray's local light has no noise";
}

}  // namespace
}  // namespace voxelume
