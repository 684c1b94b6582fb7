// SPDX-License-Identifier: Apache-2.0
// Rough glass in global light: furnaces, what is seen through it, and bits.
#include <set>

#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/light/global_light.hpp"

namespace voxelume {
namespace {

Json rough_glass(double roughness, double ior = 1.5) {
    return {{"base_color", {1, 1, 1}}, {"transmission", 1}, {"roughness", roughness}, {"ior", ior}};
}

Json glass_ball(double radius, const char* surface) {
    Json model = {{"shape", "sphere"}, {"radius", radius}, {"surface", surface}};
    if (std::string(surface) == "cubes") model["set"] = "solid";
    return model;
}

class RoughGlassBalls : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(GlobalLight, RoughGlassBalls, testing::Values("cubes", "smooth", "exact"));

TEST_P(RoughGlassBalls, AreInvisibleUnderAWhiteSky) {
    const bool is_cubes = std::string(GetParam()) == "cubes";
    for (const double roughness : {0.1, 0.4, 0.9}) {
        Json scene = open_furnace(is_exhaustive() ? 4096 : 64);
        scene["materials"]["frosted"] = rough_glass(roughness);
        scene["materials"]["half"] = {
            {"base_color", {1, 1, 1}}, {"transmission", 0.5}, {"metallic", 0.3}};
        add_thing(scene, glass_ball(0.22, GetParam()), "frosted", {0.25, 0.2, 0.1});
        add_thing(scene, glass_ball(0.2, GetParam()), "half", {-0.25, -0.2, 0.1});
        add_thing(scene, glass_ball(0.1, GetParam()), "chalk", {0.25, -0.3, 0.1});
        send_rays(scene, {0, 0, -0.55}, {0, 0, 1}, 1, 32);
        const Estimate e = estimate_of(channel_of(sense(scene), 1));
        const std::string what = "roughness " + std::to_string(roughness);
        // Cubes reflect some light totally within for ever, which the limit of bounces takes.
        if (is_cubes) {
            EXPECT_LE(e.mean, 1 + 3 * e.error + 1e-3) << what;
            EXPECT_GE(e.mean, 0.97) << what;
        } else {
            expect_mean(e, 1, what, 1e-3);
        }
    }
}

TEST(RoughGlassImage, OfAPaneReturnsAllLight) {
    // Balls hold some paths along their rims for more bounces than there are; a pane doesn't.
    for (const double roughness : {0.1, 0.4, 0.9}) {
        Json scene = open_furnace(is_exhaustive() ? 4096 : 64);
        scene["materials"]["frosted"] = rough_glass(roughness);
        add_thing(scene, {{"shape", "box"}, {"size", {1.1, 1.1, 0.2}}, {"surface", "exact"}},
                  "frosted", {0, 0, 0});
        send_rays(scene, {0, 0, -0.55}, {0, 0, 1}, 0.5, 32);
        expect_mean(estimate_of(channel_of(sense(scene), 1)), 1,
                    fmt::format("roughness {}", roughness), 1e-4);
    }
}

TEST(RoughGlassImage, OfNoRoughnessShowsWhatGlassShows) {
    // A checkered wall behind a ball of either kind of glass, whose facets are still 1/1024 wide.
    std::vector<Estimate> found;
    for (const char* kind : {"clear", "polished"}) {
        Json scene = open_furnace(64);
        scene["world"]["background"] = {0.2, 0.3, 0.5};
        scene["materials"]["clear"] = scene["materials"]["glass"];
        scene["materials"]["polished"] = rough_glass(0);
        scene["materials"]["wall"] = {{"color", {0.8, 0.8, 0.8}},
                                      {"checker", {{"color", {0.1, 0.1, 0.1}}, {"size", 0.15}}}};
        add_thing(scene, {{"shape", "box"}, {"size", {1.1, 1.1, 0.1}}, {"surface", "exact"}},
                  "wall", {0, 0, 0.5});
        add_thing(scene, glass_ball(0.3, "exact"), kind, {0.05, 0, 0});
        send_rays(scene, {0, 0, -0.55}, {0, 0, 1}, 0.5, 24);
        found.push_back(estimate_of(channel_of(sense(scene), 1)));
    }
    const double error = std::hypot(found[0].error, found[1].error);
    fmt::print("glass {:.5f}, polished {:.5f} +- {:.5f}\n", found[0].mean, found[1].mean, error);
    EXPECT_NEAR(found[0].mean, found[1].mean, 0.01 * found[0].mean);
}

TEST(RoughGlassImage, AbsorbsInsideAndTintsAtBothSurfaces) {
    // Straight through a polished slab of 0.2 m: both surfaces tint and reflect, and so on inside.
    Json scene = open_furnace(256);
    scene["world"]["background"] = {1, 1, 1};
    scene["materials"]["jade"] = rough_glass(0, 1.5);
    scene["materials"]["jade"]["base_color"] = {1, 0.5, 0.25};
    scene["materials"]["jade"]["absorption"] = {0, 0, 3};
    add_thing(scene, {{"shape", "box"}, {"size", {1.1, 1.1, 0.2}}, {"surface", "exact"}}, "jade",
              {0, 0, 0});
    send_rays(scene, {0, 0, -0.55}, {0, 0, 1}, 0.2, 16);
    const std::vector<SensedRay> rays = sense(scene);
    const double tints[3] = {1, 0.5, 0.25}, absorptions[3] = {0, 0, 3};
    for (int c = 0; c < 3; ++c) {
        // F + T² (tint e)² / e ... as a series of reflections inside.
        const double f = 0.04, t = (1 - f) * tints[c], e = std::exp(-0.2 * absorptions[c]);
        const double through = t * t * e / (1 - f * f * e * e);
        const double back = f + t * t * f * e * e / (1 - f * f * e * e);
        expect_mean(estimate_of(channel_of(rays, c)), through + back,
                    "channel " + std::to_string(c), 2e-3);
    }
}

TEST(RoughGlassImage, HasTheSameBitsOnAnyNumberOfLanes) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    Json scene = open_furnace(2);
    scene["materials"]["frosted"] = rough_glass(0.3);
    scene["materials"]["frosted"]["absorption"] = {0.5, 1, 2};
    scene["materials"]["lamp"] = {{"color", {0, 0, 0}}, {"emission", {6, 4, 2}}};
    add_thing(scene, glass_ball(0.2, "smooth"), "frosted", {0.2, 0.2, 0});
    add_thing(scene, glass_ball(0.2, "cubes"), "frosted", {-0.2, 0.2, 0});
    add_thing(scene, glass_ball(0.2, "exact"), "frosted", {0.2, -0.2, 0},
              {{"placement", "instance"}});
    add_thing(scene, glass_ball(0.1, "exact"), "lamp", {-0.2, -0.2, 0.2});
    send_rays(scene, {0, 0, -0.55}, {0, 0, 1}, 1, 13);
    std::set<uint64_t> hashes;
    for (const int lanes : lanes_with_all()) {
        RenderReport report;
        hashes.insert(oracle::image_hash(
            render(test_device(lanes), parse_scene(scene.dump(), "glass", {}), report)));
        EXPECT_EQ(report.not_finite, 0u);
    }
    EXPECT_EQ(hashes.size(), 1u);
}

}  // namespace
}  // namespace voxelume
