// SPDX-License-Identifier: Apache-2.0
// Pictures lit with the beams of lights equal those lit without.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "runtime/render/illumination.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/stages/trace/ray_arrays.hpp"
#include "runtime/stages/trace/sight.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kImageSeed = 20261123;

/// A scene of balls of one surface above a floor, some of which are mirrors, with two lights
/// outside the world.
Scene balls(const std::string& surface, double reflection, const std::string& light) {
    std::mt19937 random(kImageSeed);
    const auto uniform = [&] { return double(random()) / 0x1p32; };
    std::string objects;
    for (int i = 0; i < 30; ++i) {
        const double x = uniform(), y = uniform(), z = uniform();
        objects +=
            fmt::format(R"(, {{"model": "ball", "material": "{}", "position": [{}, {}, {}]}})",
                        i % 3 == 0 ? "mirror" : "wall", 3 * x - 1.5, 2 * y - 0.2, 2 * z);
    }
    return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.02, "bounds": {{"min": [-2, -1, -2], "max": [2, 2, 2.4]}}}},
"materials": {{"wall": {{"color": [0.8, 0.7, 0.6]}}, "mirror": {{"reflection": {}}}}},
"models": {{"floor": {{"shape": "box", "size": [4, 0.2, 4], "surface": "{}"}},
           "ball": {{"shape": "sphere", "radius": 0.15, "surface": "{}"}}}},
"objects": [{{"model": "floor", "material": "wall", "position": [0, -0.7, 0.2]}}{}],
"lights": [{{"type": "point", "position": [1.5, 12, -1], "intensity": 90}}, {}],
"observer": {{"position": [0, 0.6, -1.5], "look_at": [0, 0.1, 1],
             "display": {{"shape": "pyramid", "angles": [80, 80]}}}},
"render": {{"size": [256, 256], "depth": 1}}}})",
                                   reflection, surface, surface, objects, light),
                       "balls.json", {});
}

constexpr const char* kDistant =
    R"({"type": "directional", "direction": [-1, -2, 0.5], "intensity": 1})";

/// The light that the observer's rays bring back: three components per ray.
std::vector<float> light_of(const Scene& scene, const BuiltWorld& built, bool with_beams) {
    const Device device = test_device();
    const Pyramid& world = built.pyramid;
    const Features features = features_of(scene, world);
    const Camera observer = camera_of(scene, world.frame);
    const uint32_t tiles = tile_count(observer.width, observer.height);
    RayBatch batch = allocate_batch(device, features, tiles * 16);
    Illumination illumination(device, features, scene, world, batch.stride);
    if (with_beams) {
        std::vector<LightBeams> sent;
        illumination.send_beams(build_dilated_occupancy(device, world), 1u << 20, sent);
        EXPECT_GT(illumination.light_beams(), 1000u);
    }
    SightStage(device, features, observer).cast(shape_of(world), 0, tiles, batch);
    illumination.light(batch, tiles * 16);
    EXPECT_GT(illumination.shadow_rays(), 50000u);
    return batch.radiance.read();
}

using SurfaceAndReflection = std::tuple<const char*, double>;
class LightBeamSurfaces : public testing::TestWithParam<SurfaceAndReflection> {};
INSTANTIATE_TEST_SUITE_P(LightBeams, LightBeamSurfaces,
                         testing::Values(SurfaceAndReflection("cubes", 0),
                                         SurfaceAndReflection("smooth", 0),
                                         SurfaceAndReflection("smooth", 0.5),
                                         SurfaceAndReflection("exact", 0.5)));

TEST_P(LightBeamSurfaces, AreLitAsWithoutBeams) {
    const auto [surface, reflection] = GetParam();
    const Scene scene = balls(surface, reflection, kDistant);
    WorldReport report;
    const BuiltWorld world = WorldBuilder(test_device(), false, AssetStore()).build(scene, report);
    EXPECT_EQ(light_of(scene, world, true), light_of(scene, world, false));
}

/// Unchanged beams aren't built again: a light that stays keeps its beams while another moves.
TEST(LightBeams, AreKeptForLightsThatStay) {
    const Device device = test_device();
    WorldBuilder builder(device, true, AssetStore());
    Renderer renderer(device);
    std::vector<uint64_t> sent;
    for (const double x : {0.0, 0.1, 0.1, 0.2}) {
        Scene scene = balls(
            "cubes", 0,
            fmt::format(R"({{"type": "point", "position": [{}, 12, 0], "intensity": 9}})", x));
        if (sent.size() == 2) scene.observer.position.x += 0.01;
        RenderReport report;
        const BuiltWorld world = builder.build(scene, report.world);
        renderer.image(scene, world, report);
        sent.push_back(report.light_beams);
    }
    EXPECT_GT(sent[0], sent[1]);
    EXPECT_GT(sent[1], 0u);
    EXPECT_EQ(sent[2], 0u) << "the observer moved, no light did";
    EXPECT_GT(sent[3], 0u);
}

}  // namespace
}  // namespace voxelume
