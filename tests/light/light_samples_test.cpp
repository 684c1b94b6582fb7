// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/light_samples.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "runtime/stages/trace/trace.hpp"
#include "tests/light/area_light_scenes.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

using testing::Contains;
using testing::Key;
using testing::Not;

using std::numbers::pi;

/// A surface, and the placement of the emissive object with it.
struct EmissiveCase {
    const char* surface;
    const char* placement = "world";
};

/// The case's place as keys of an object.
std::string placement_of(const EmissiveCase& emissive) {
    return fmt::format(R"(, "placement": "{}")", emissive.placement);
}

std::string ball_model(const std::string& surface) {
    return R"("lamp": {"shape": "sphere", "radius": 0.1, "voxel_size": 0.01, "surface": ")" +
           surface + (surface == "cubes" ? R"(", "set": "solid"},)" : R"("},)");
}

/// An emissive ball of 0.1 m around (0.05, 0.5, 0.1); the observer above sees it in the image's
/// middle.
Scene ball_scene(const std::string& surface, const std::string& more = "") {
    return floor_scene(
        ball_model(surface),
        R"({"name": "lamp", "model": "lamp", "material": "glow", "position": [0.05, 0.5, 0.1])" +
            more + "},",
        "");
}

class EmissiveObjects : public testing::TestWithParam<EmissiveCase> {
  protected:
    static Scene scene_of_case() {
        return ball_scene(GetParam().surface, placement_of(GetParam()));
    }
};

TEST_P(EmissiveObjects, GiveAFacingSurfaceTheRadianceTimesTheirSolidAngle) {
    Scene scene = scene_of_case();
    scene.objects[0].light_samples = 512;
    const Image image = image_of(scene);
    for (const double x : {-0.35, -0.2, 0.3, 0.45}) {
        const size_t pixel = pixel_at(image, x, 0.22);
        const glm::dvec3 to_emissive_object = glm::dvec3(0.05, 0.5, 0.1) - point_at(image, pixel);
        const double distance = glm::length(to_emissive_object);
        const double expected = std::pow(0.1 / distance, 2) * to_emissive_object.y / distance;
        const double bound = 0.02 * expected;
        EXPECT_NEAR(image.planes.at("R")[pixel], 3 * expected, 3 * bound) << x;
        EXPECT_NEAR(image.planes.at("B")[pixel], 0.25 * expected, 0.25 * bound) << x;
    }
}

TEST_P(EmissiveObjects, AreSeenWithTheirOwnEmission) {
    const Image image = image_of(scene_of_case());
    ASSERT_GT(point_at(image, pixel_at(image, 0.05, 0.1)).y, 0.5);
    for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
        if (point_at(image, i).y < 0.4) continue;
        ASSERT_EQ(image.planes.at("R")[i], 3.0f) << "a convex object does not light itself";
        ASSERT_EQ(image.planes.at("B")[i], 1.0f);
    }
}

TEST_P(EmissiveObjects, AreNotHiddenByTheirOwnSurface) {
    Scene scene = scene_of_case();
    const Image shadowed = image_of(scene);
    scene.render.shadows = false;
    const Image bare = image_of(scene);
    for (size_t i = 0; i < bare.planes.at("R").size(); ++i)
        ASSERT_EQ(shadowed.planes.at("R")[i], bare.planes.at("R")[i]) << i;
}

// Cubes are left out: the stairs of a ball light and shadow one another, and enlarge it.
INSTANTIATE_TEST_SUITE_P(Surfaces, EmissiveObjects,
                         testing::Values(EmissiveCase{"smooth"}, EmissiveCase{"exact"},
                                         EmissiveCase{"smooth", "instance"},
                                         EmissiveCase{"exact", "instance"}));

TEST(EmissiveObject, OfCubesGivesTheFormFactorOfTheFaceThatIsSeen) {
    const Scene scene = floor_scene(
        R"("lamp": {"shape": "box", "size": [0.28, 0.03, 0.15], "surface": "cubes", "set": "solid"},)",
        R"({"model": "lamp", "material": "glow", "position": [0.05, 0.38, 0.1], "spots": 4000},)",
        "");
    const Device device = test_device();
    RenderReport report;
    const Pyramid world = build_world(device, scene, report.world);
    const glm::dvec3& edge = world.frame.voxel_edge;
    glm::dvec3 low(1e9),
        high(-1e9);  // height of the light samples that face down, in metres from the world's first
                     // corner
    for (const LightRecord& light_sample :
         emissive_light_samples(device, features_of(world), scene, world)) {
        if (light_sample.direction.y > -0.5f) continue;
        const glm::dvec3 p =
            glm::dvec3(light_sample.position.x, light_sample.position.y, light_sample.position.z) *
            edge;
        low = glm::min(low, p - edge / 2.0);
        high = glm::max(high, p + edge / 2.0);
    }
    Scene from_below =
        scene;  // an observer between the floor and the emissive object sees only the floor
    from_below.observer.position = {0.05, 0.2, 0.1};
    from_below.observer.display.half_size = {0.05, 0.03};
    const Image image = image_of(from_below);
    for (size_t i = 0; i < image.planes.at("R").size(); i += 77) {
        const glm::dvec3 p = point_at(image, i) - world.frame.origin;
        const double height = (low.y + high.y) / 2 - p.y - edge.x / 32;
        double factor = 0;
        for (const double a : {p.x - low.x, high.x - p.x})
            for (const double b : {p.z - low.z, high.z - p.z})
                factor += corner_form_factor(a, b, height);
        EXPECT_NEAR(image.planes.at("R")[i], 3 * factor, 0.01 * 3 * factor) << i;
    }
}

/// A box turned a little, or of cubes along the axes: flat faces, seen at all angles.
class FlatEmissiveObjects : public testing::TestWithParam<EmissiveCase> {};

TEST_P(FlatEmissiveObjects, AreNotHiddenByTheirOwnSurface) {
    const std::string surface = GetParam().surface;
    const bool is_cubes = surface == "cubes";
    Scene scene = floor_scene(
        R"("lamp": {"shape": "box", "size": [0.18, 0.03, 0.13], "voxel_size": 0.01, "surface": ")" +
            surface + (is_cubes ? R"(", "set": "solid"},)" : R"("},)"),
        std::string(R"({"model": "lamp", "material": "glow", "position": [0.05, 0.4, 0.1])") +
            (is_cubes ? "" : R"(, "turn": [20, 30, 10])") + R"(, "spots": 100)" +
            placement_of(GetParam()) + "},",
        "");
    const Image shadowed = image_of(scene);
    scene.render.shadows = false;
    const Image bare = image_of(scene);
    size_t lit = 0, dimmed = 0;
    for (size_t i = 0; i < bare.planes.at("R").size(); ++i) {
        if (!is_floor(bare, i)) continue;
        const float whole = bare.planes.at("R")[i], seen = shadowed.planes.at("R")[i];
        dimmed += seen != whole;
        // The object is 1.5 voxels thin. At its smooth edges a small part of one light sample
        // of 100 may be hidden.
        ASSERT_NEAR(seen, whole, surface == "smooth" ? 1e-3 * whole : 0) << i;
        lit += bare.planes.at("R")[i] > 0;
    }
    EXPECT_GT(lit, 500u);
    // An instance has voxels half as large, and so more edges that light may graze.
    const bool is_instance = std::string(GetParam().placement) == "instance";
    EXPECT_LE(dimmed, surface == "smooth" ? lit / (is_instance ? 40 : 100) : 0);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, FlatEmissiveObjects,
                         testing::Values(EmissiveCase{"cubes"}, EmissiveCase{"smooth"},
                                         EmissiveCase{"exact"}, EmissiveCase{"cubes", "instance"},
                                         EmissiveCase{"smooth", "instance"},
                                         EmissiveCase{"exact", "instance"}));

TEST(EmissiveObject, InsideAnEmissiveShellASurfaceReturnsItsColorTimesTheRadiance) {
    // A hollow ball surrounds the whole floor and is cut off at the world's bottom. Half of the sky
    // that the surface sees is the shell down to the floor.
    Scene scene = floor_scene(
        R"("shell": {"shape": "difference", "surface": "exact",
                     "parts": [{"shape": "sphere", "radius": 0.36}, {"shape": "sphere", "radius": 0.3}]},)",
        R"({"model": "shell", "material": "glow", "position": [0.1, 0.02, 0.1], "spots": 2048},)",
        "");
    scene.observer.position = {0.1, 0.2, 0.1};
    scene.observer.display.half_size = {0.04, 0.03};
    const Image inside = image_of(scene);
    for (size_t i = 0; i < inside.planes.at("R").size(); i += 100)
        EXPECT_NEAR(inside.planes.at("R")[i], 3, 0.06) << i;
}

TEST(EmissiveObject, GivesTheSameBitsWithAnyNumberOfLanes) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    size_t turn = 0;
    for (const char* surface : {"cubes", "smooth", "exact"}) {
        const Scene scene = ball_scene(surface, R"(, "spots": 32)");
        const uint64_t expected = oracle::image_hash(image_of(scene, 1));
        for (const int lanes : in_turn<int>({4, 16}, turn++))
            EXPECT_EQ(oracle::image_hash(image_of(scene, lanes)), expected)
                << surface << " with " << lanes << " lanes";
    }
}

TEST(EmissiveObject, WithoutLightSamplesIsSeenButLightsNothing) {
    const Scene scene = ball_scene("smooth", R"(, "spots": 0)");
    const Device device = test_device();
    RenderReport report;
    const Image image = render(device, scene, report);
    for (size_t i = 0; i < image.planes.at("R").size(); ++i)
        ASSERT_EQ(image.planes.at("R")[i], is_floor(image, i) ? 0.0f : 3.0f);
    const DeviceCounters& counters = device.counters();
    for (const char* kernel : {"list_emissive", "find_surface", "add_light", "trace_shadows"})
        EXPECT_THAT(counters.launches, Not(Contains(Key(std::string(kernel)))));
    for (const char* buffer : {"emissive objects", "emissive surface", "shadow queue"})
        EXPECT_THAT(counters.allocated_bytes, Not(Contains(Key(std::string(buffer)))));
}

TEST(EmissiveObject, ThatTheWorldCutsOffShinesInwardsOnly) {
    // The slab extends above the world's top, y = 0.8.
    Scene scene = floor_scene(
        R"("lamp": {"shape": "box", "size": [0.3, 0.4, 0.2], "surface": "cubes", "set": "solid"},)",
        R"({"model": "lamp", "material": "glow", "position": [0.05, 0.9, 0.1], "spots": 64},)", "");
    RenderReport report;
    const Device device = test_device();
    const Pyramid world = build_world(device, scene, report.world);
    const std::vector<LightRecord> light_samples =
        emissive_light_samples(device, features_of(world), scene, world);
    EXPECT_EQ(light_samples.size(), 64u);
    for (const LightRecord& light_sample : light_samples) {
        EXPECT_LE(light_sample.direction.y, 0);
        EXPECT_LT(light_sample.position.y, float(world.frame.size.y));
    }
}

TEST(EmissiveObject, HasASpotForEverySixteenVoxelFacesWithinLimits) {
    EXPECT_EQ(default_light_samples(1e-9, {0.1, 0.1, 0.1}), 16);
    EXPECT_EQ(default_light_samples(16 * 0.01 * 50, {0.1, 0.1, 0.1}), 50);
    EXPECT_EQ(default_light_samples(16 * 0.01 * 50, {0.1, 0.1, 0.2}), 16);
    EXPECT_EQ(default_light_samples(1e9, {0.1, 0.1, 0.1}), 128);
}

}  // namespace
}  // namespace voxelume
