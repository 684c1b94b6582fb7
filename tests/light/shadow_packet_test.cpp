// SPDX-License-Identifier: Apache-2.0
// Shadow rays whose packets refill lanes as rays end, in a room lit from inside. The light on the
// visible surfaces is that of packets without refill, for any number of lanes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kSeed = 20261122;

/// A scene of a room inside a ball, with 40 balls and two lights in it. With `veils` every fourth
/// ball lets half of the light through. A ball of the material `hidden` is behind the observer,
/// where nothing that it sees shows it.
Scene room(bool veils, const std::string& hidden, const std::string& placement = "world") {
    std::mt19937 random(kSeed);
    const auto coordinate = [&] { return double(random()) / 0x1p32 * 3.2 - 1.6; };
    std::string balls;
    for (int i = 0; i < 40; ++i) {
        const double x = coordinate(), y = coordinate(), z = coordinate() / 1.6 * 1.1 + 0.4;
        balls += fmt::format(R"(, {{"model": "ball", "material": "{}", "position": [{}, {}, {}]}})",
                             i % 4 == 0 ? "veil" : "wall", x, y, z);
    }
    return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.08, "bounds": {{"min": [-2.2, -2.2, -2.2], "max": [2.2, 2.2, 2.2]}},
          "ambient": [0.02, 0.02, 0.02]}},
"materials": {{"wall": {{"color": [0.8, 0.7, 0.6]}}, "mirror": {{"reflection": 0.5}},
              "veil": {{"color": [0.9, 0.5, 0.5]{}}}}},
"models": {{"room": {{"shape": "sphere", "radius": 2.003, "surface": "exact"}},
           "ball": {{"shape": "sphere", "radius": 0.12, "surface": "exact"}}}},
"objects": [{{"model": "room", "material": "wall"}}{},
            {{"model": "ball", "material": "{}", "position": [0, 0, -1.6],
              "placement": "{}"}}],
"lights": [{{"type": "point", "position": [0.3, 1.9, 0.5], "intensity": 3}},
           {{"type": "point", "position": [-1.1, -1.2, 1.05], "intensity": 3}}],
"observer": {{"position": [0, 0, -1.3], "look_at": [0, 0, 1],
             "display": {{"shape": "pyramid", "angles": [100, 100]}}}},
"render": {{"size": [96, 96], "depth": 2}}}})",
                                   veils ? R"(, "opacity": 0.5)" : "", balls, hidden, placement),
                       "room.json", {});
}

std::map<std::string, Plane<float>> colors(const Scene& scene, int lanes = 0) {
    RenderReport report;
    const Image image = render(test_device(lanes), scene, report);
    EXPECT_GE(report.shadow_rays, scene.render.size.x * scene.render.size.y);
    std::map<std::string, Plane<float>> colors;
    for (const char* channel : {"R", "G", "B"}) colors[channel] = image.planes.at(channel);
    return colors;
}

/// In scenes with instances packets keep their rays: no lane is refilled.
TEST(ShadowPacket, AnInstanceThatNobodySeesChangesNothing) {
    Scene flying = room(false, "wall"), keeping = room(false, "wall", "instance");
    for (const Surface surface : {Surface::exact, Surface::smooth}) {
        for (Scene* scene : {&flying, &keeping})
            for (Model& model : scene->models) model.surface = surface;
        EXPECT_EQ(colors(flying), colors(keeping));
    }
}

TEST(ShadowPacket, AMirrorThatNobodySeesChangesNothing) {
    EXPECT_EQ(colors(room(false, "mirror")), colors(room(false, "wall")));
}

class Veils : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(ShadowPacket, Veils, testing::Bool());

TEST_P(Veils, PacketsThatKeepTheirRaysGiveTheSameLight) {
    const Scene packets = room(GetParam(), "mirror", "instance");
    EXPECT_EQ(colors(room(GetParam(), "mirror")), colors(packets));
}

TEST_P(Veils, LanesDoNotChangeABit) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    const Scene scene = room(GetParam(), "mirror");
    const auto expected = colors(scene, 1);
    for (const int lanes : in_turn<int>({4, 16}, GetParam()))
        EXPECT_EQ(colors(scene, lanes), expected) << lanes;
}

/// The light on a wall from a far light through a row of `voxels` voxels, each of which absorbs a
/// thousandth.
double light_behind(int voxels) {
    const Scene scene = parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 1, "bounds": {{"min": [-4, -4, -4], "max": [{0}, 4, 4]}}}},
"materials": {{"wall": {{"color": [0.8, 0.8, 0.8]}},
              "veil": {{"color": [1, 1, 1], "opacity": 0.001}}}},
"models": {{"wall": {{"shape": "box", "size": [2, 8, 8], "surface": "cubes"}},
           "veil": {{"shape": "box", "size": [{1}, 4, 4], "surface": "cubes", "set": "solid"}}}},
"objects": [{{"model": "wall", "material": "wall", "position": [-3, 0, 0]}},
            {{"model": "veil", "material": "veil", "position": [{2}, 0, 0]}}],
"lights": [{{"type": "directional", "direction": [-1, 0, 0], "intensity": 3}}],
"observer": {{"position": [1, 0, 0], "look_at": [-2, 0, 0],
             "display": {{"shape": "pyramid", "angles": [20, 20]}}}},
"render": {{"size": [8, 8]}}}})",
                                                voxels + 8, voxels, 2 + voxels / 2.0),
                                    "veil.json", {});
    return colors(scene).at("R")[27];
}

TEST(ShadowPacket, LightPassesThousandsOfSurfaces) {
    const double one = light_behind(1);
    for (const int voxels : {101, 1101, 3001})
        EXPECT_NEAR(light_behind(voxels) / one, std::pow(0.999, voxels - 1), 3001 * 0x1p-23)
            << voxels;
}

}  // namespace
}  // namespace voxelume
