// SPDX-License-Identifier: Apache-2.0
// Objects of cubes that let light through: their voxels form one body, and only its faces refract.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/render/illumination.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/stages/trace/sight.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/glass/refracted_rays.hpp"
#include "tests/pictures/glass_block.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume::glass_block {
namespace {

constexpr uint32_t kRays = 192;  // of a scene's image

TEST(GlassCubes, ASlabShiftsRaysAsSnellSays) {
    const Scene scene = parse_scene(
        block_scene(R"({"diffuse": 0, "refraction": 1, "ior": 1.5})", -20), "test.json", {});
    RefractedRays rays(scene, kRays);
    std::vector<glm::dvec3> direction, entry;
    for (uint32_t i = 0; i < kRays; ++i) {
        direction.push_back(rays.direction(i));
        entry.push_back(rays.position(i) * 0.125);
        ASSERT_TRUE(rays.is_hit(i)) << i;
        ASSERT_EQ(rays.side(i), 0u);
        ASSERT_EQ(rays.normal(i), glm::dvec3(0, 1, 0));
        ASSERT_EQ(entry[i].y, 0.5 + 2.5);
    }
    rays.refract();
    std::vector<glm::dvec3> exit;
    for (uint32_t i = 0; i < kRays; ++i) {
        const glm::dvec3& d = direction[i];
        glm::dvec3 bent = d / 1.5;
        bent.y = -std::sqrt(1 - bent.x * bent.x - bent.z * bent.z);
        exit.push_back(entry[i] + bent * (-1.0 / bent.y));
        ASSERT_TRUE(rays.is_hit(i)) << i;
        EXPECT_EQ(rays.side(i), VXL_SIDE_LEAVING);
        EXPECT_EQ(rays.normal(i), glm::dvec3(0, 1, 0));
        EXPECT_LT(glm::distance(rays.position(i) * 0.125, exit[i]), 1e-5) << i;
        EXPECT_LT(glm::distance(rays.direction(i), bent), 1e-5) << i;
    }
    rays.refract();
    for (uint32_t i = 0; i < kRays; ++i) {
        EXPECT_LT(glm::distance(rays.direction(i), direction[i]), 1e-5) << i;
        EXPECT_FALSE(rays.is_hit(i)) << i;
    }
}

constexpr const char* kGhost = R"({"diffuse": 0, "refraction": 1, "ior": 1})";

TEST(GlassCubes, AreMetByAnObserverInsideOnlyWhereTheyEnd) {
    constexpr const char* kFromInside =
        R"("position": [0.2, 0.07, 0.03], "look_at": [5, 0.07, 0.03],
              "display": {"shape": "box", "size": [0.4, 0.3, 12]})";
    const Image image = picture_of(
        block_scene(R"({"diffuse": 0, "refraction": 0.75, "ior": 1.5})", -20, kFromInside));
    const float background[3] = {0.25f, 0.5f, 0.75f};
    for (int c = 0; c < 3; ++c)
        for (const float value : image.planes.at(kColors[c]))
            EXPECT_NEAR(value, 0.75f * background[c], 1e-6);
}

TEST(GlassCubes, OfTheSpacesOwnIndexAreInvisibleToTheBit) {
    uint64_t secondary_rays = 0;
    const Image with = picture_of(block_scene(kGhost), 0, &secondary_rays);
    const Image without = picture_of(block_scene(kGhost, -2, kFromAbove, ""));
    EXPECT_GT(secondary_rays, 300u);
    for (const char* color : kColors)
        EXPECT_EQ(with.planes.at(color), without.planes.at(color)) << color;
}

TEST(GlassCubes, TouchingAnotherObjectAreLeftWhereItBegins) {
    // The floor touches the block's lower face.
    const char* observer = R"("position": [4, 3, -5], "look_at": [0, -0.5, 0],
              "display": {"shape": "pyramid", "angle": 25})";
    const Image with = picture_of(block_scene(kGhost, -0.6, observer));
    const Image without = picture_of(block_scene(kGhost, -0.6, observer, ""));
    for (const char* color : kColors)
        EXPECT_EQ(with.planes.at(color), without.planes.at(color)) << color;
}

TEST(GlassCubes, SolidOnesAbsorbAlongTheWholeWay) {
    // Bricks inside the block must count, too.
    const Image image = picture_of(block_scene(
        R"({"diffuse": 0, "refraction": 1, "ior": 1, "absorption": [0.3, 0.7, 0]})", -2, kThrough));
    const double expected[] = {0.25 * std::exp(-0.3 * 3.75), 0.5 * std::exp(-0.7 * 3.75), 0.75};
    for (int c = 0; c < 3; ++c)
        for (const float value : image.planes.at(kColors[c]))
            EXPECT_NEAR(value, expected[c], 1e-5) << c;
}

TEST(GlassCubes, EveryVoxelOfLittleOpacityCoversOnce) {
    // The light falls on faces that the observer doesn't see.
    std::string scene =
        block_scene(R"({"color": [1, 1, 1], "diffuse": 1, "opacity": 0.07})", -2, kThrough);
    const std::string light = "[0.3, 2.2, -2.1]";
    scene.replace(scene.find(light), light.size(), "[2.7, 0.1, 0]");
    const Image image = picture_of(scene);
    const double ambient[] = {0.1, 0.2, 0.3}, background[] = {0.25, 0.5, 0.75};
    const double left = std::pow(0.93, 30);
    for (int c = 0; c < 3; ++c)
        for (const float value : image.planes.at(kColors[c]))
            EXPECT_NEAR(value, left * background[c] + (1 - left) * ambient[c], 2e-5) << c;
    for (const float value : image.planes.at("A")) EXPECT_NEAR(value, 1 - left, 1e-5);
}

/// A closed room of cubes full of glass cubes and mirrors; its background is far too bright.
std::string leaky_room(int depth, int pixels) {
    return R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1.1, -1.1, -1.1], "max": [1.1, 1.1, 1.1]},
          "background": [1e6, 1e6, 1e6], "ambient": [1, 1, 1]},
"materials": {"wall": {"color": [0.5, 0.5, 0.5], "reflection": 0.5},
              "mirror": {"diffuse": 0, "reflection": 1},
              "haze": {"opacity": 0.1},
              )" +
           std::string(kMaterials) + R"(,
              "glass": {"diffuse": 0, "reflection": 1, "refraction": 1, "ior": 1.5, "fresnel": true}},
"models": {"room": {"shape": "difference", "surface": "cubes", "set": "solid", "parts": [
              {"shape": "box", "size": [2.1, 2.1, 2.1]}, {"shape": "box", "size": [1.9, 1.9, 1.9]}]},
           "ball": {"shape": "sphere", "radius": 0.35, "surface": "cubes", "set": "solid"},
           "shell": {"shape": "sphere", "radius": 0.3, "surface": "cubes"},
           "smooth ball": {"shape": "sphere", "radius": 0.3, "surface": "smooth"},
           "block": {"shape": "box", "size": [0.5, 0.4, 0.3], "surface": "cubes", "set": "solid"},
           )" +
           kModels + R"(},
"objects": [{"model": "room", "material": "wall"},
            {"model": "ball", "material": "glass", "position": [-0.31, 0.22, 0.13]},
            {"model": "block", "material": "glass", "position": [-0.31, 0.22, 0.13], "priority": 1},
            {"model": "shell", "material": "glass", "position": [0.4, 0.35, 0.2]},
            {"model": "smooth ball", "material": "glass", "position": [0.3, 0.45, 0.2], "priority": 1},
            {"model": "ball", "material": "mirror", "position": [0.4, -0.4, 0.3]},
            {"model": "block", "material": "haze", "position": [0.1, 0, -0.2]},
            {"model": "block", "material": "glass", "position": [-0.3, -0.5, 0.2], "turn": [33, 20, 0]},
            {"model": "far cube", "material": "all", "position": [0.6, 0.7, -0.6]}],
"observer": {"position": [0.1, 0.05, -0.8], "look_at": [0, 0, 0.3],
             "display": {"shape": "pyramid", "angle": 90}},
"lights": [{"type": "point", "position": [-0.6, 0.8, -0.8], "intensity": 1e-3}],
"render": {"shadow": "filtered", "size": [)" +
           std::to_string(pixels) + ", " + std::to_string(pixels) + R"(], "depth": )" +
           std::to_string(depth) + "}}";
}

TEST(GlassCubes, NoRayLeavesAClosedRoom) {
    uint64_t secondary_rays = 0;
    const Image image = picture_of(leaky_room(9, 28), 0, &secondary_rays);
    EXPECT_GT(secondary_rays, 10'000u);
    size_t leaks = 0;
    for (const float value : image.planes.at("R")) leaks += value > 2;
    EXPECT_EQ(leaks, 0u) << "of " << secondary_rays << " secondary rays";
}

// CTest runs this program with 1, 4, 8 and 16 lanes. A change that intends to change the image
// replaces the hash by the one that this prints.
TEST(GlassCubes, AreTheSameToTheBitHoweverManyRaysAreTracedAtOnce) {
    EXPECT_EQ(fmt::format("{:016x}", oracle::image_hash(picture_of(leaky_room(3, 40)))),
              "b046144c322a3264");
}

TEST(GlassCubes, AreNotThereWhereNoCubesTransmit) {
    Scene scene = parse_scene(block_scene(R"({"reflection": 0.5})"), "test.json", {});
    Scene opaque = scene;
    opaque.objects.resize(2);
    EXPECT_FALSE(features_of(opaque, {}).cube_bodies);
    EXPECT_TRUE(features_of(scene, {}).cube_bodies);
    for (Model& model : scene.models) model.surface = Surface::exact;
    EXPECT_FALSE(features_of(scene, {}).cube_bodies);
}

}  // namespace
}  // namespace voxelume::glass_block
