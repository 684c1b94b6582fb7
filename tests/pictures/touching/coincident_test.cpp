// SPDX-License-Identifier: Apache-2.0
// Objects whose exact surfaces coincide: boxes with one top, balls in one place, glass that stands
// on a table, blocks of glass side by side.
//
// Where surfaces coincide, rounding alone says which of them a ray meets first. Pictures in which
// nothing coincides tell what has to be shown instead: the object that counts is moved by an eighth
// of a voxel so that it covers the other. The pictures differ in few pixels, next to edges.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_device.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

constexpr double kBoxVoxel = 1 / 48.0, kMovedBy = kBoxVoxel / 8;
constexpr int kPixelsWide = 160, kPixelsHigh = 120;

class Coincident : public FileTest {
  protected:
    /// A picture of objects, from above and aside, in the light of a point behind the observer's
    /// shoulder. The boxes a and b, and the floor, are solids, or meshes where `shape` says so.
    Image picture_of(const std::string& objects, bool meshes = false, double turn = 0.7) {
        const auto shape = [&](const char* name, double x, double y, double z) {
            if (!meshes)
                return fmt::format(R"("{}": {{"shape": "box", "size": [{}, {}, {}]}})", name, x, y,
                                   z);
            const glm::vec3 half(x / 2, y / 2, z / 2);
            write_obj(folder / fmt::format("{}.obj", name), box(-half, half));
            return fmt::format(R"("{0}": {{"mesh": "{0}.obj", "surface": "exact"}})", name);
        };
        if (!std::filesystem::exists(folder / "sheet.obj"))
            write_obj(folder / "sheet.obj", box(glm::vec3(0), glm::vec3(1)));
        const std::string text = fmt::format(
            R"({{"voxelume": 1,
"world": {{"voxel_size": {}, "bounds": {{"min": [-1, -0.25, -1], "max": [1, 1, 1]}},
           "ambient": [0.1, 0.1, 0.1], "background": [0.25, 0.5, 0.75]}},
"materials": {{"red": {{"color": [0.9, 0.1, 0.1]}}, "green": {{"color": [0.1, 0.9, 0.1]}},
    "veil": {{"color": [0.2, 0.2, 0.9], "opacity": 0.4}},
    "glass": {{"color": [0.9, 1, 0.9], "refraction": 0.9, "reflection": 0.1, "ior": 1.5}},
    "water": {{"color": [0.9, 0.95, 1], "refraction": 0.95, "ior": 1.33}}}},
"models": {{{}, {}, {}, {}, "ball": {{"shape": "sphere", "radius": 0.4}},
           "can": {{"shape": "cylinder", "radius": 0.3, "height": 0.5}},
           "drum": {{"shape": "cylinder", "radius": 0.3, "height": 0.3}},
           "common": {{"shape": "intersection", "parts": [{{"shape": "box", "size": [0.4, 0.5, 0.6]}},
               {{"shape": "box", "size": [0.9, 0.9, 0.9]}}]}},
           "sheet": {{"mesh": "sheet.obj", "surface": "exact"}}}},
"objects": [{}],
"lights": [{}],
"observer": {{"position": [{}, 1.9, {}], "look_at": [0, 0.1, 0],
              "display": {{"shape": "pyramid", "angle": 36}}}},
"render": {{"size": [{}, {}], "depth": 6}}}})",
            kBoxVoxel, shape("a", 0.8, 0.4, 0.8), shape("b", 0.4, 0.4, 1.2),
            shape("floor", 1.8, 0.2, 1.8), shape("block", 0.4, 0.5, 0.6), objects, lights_,
            3 * std::sin(turn), -3 * std::cos(turn), kPixelsWide, kPixelsHigh);
        RenderReport report;
        Image image = render(test_device(), parse_scene(text, folder / "scene.json", {}), report);
        EXPECT_EQ(report.not_finite, 0u);
        EXPECT_EQ(report.medium_overflows, 0u);
        return image;
    }

    std::string lights_ = R"({"type": "directional", "direction": [0.4, -1, 0.3]})";
};

/// The pixels whose light differs by more than a hundredth.
int pixels_that_differ(const Image& a, const Image& b) {
    int count = 0;
    for (int i = 0; i < kPixelsWide * kPixelsHigh; ++i) {
        double maximum = 0;
        for (const char* channel : {"R", "G", "B"})
            maximum = std::max(maximum, std::abs(double(a.planes.at(channel)[size_t(i)]) -
                                                 double(b.planes.at(channel)[size_t(i)])));
        count += maximum > 0.01;
    }
    return count;
}

/// The pixels that differ because an eighth of a voxel was moved: those of some edges' parts.
constexpr int kMaxAtEdges = 90;

TEST_F(Coincident, TopsShowTheObjectOfTheHigherPriority) {
    for (const bool meshes : {false, true})
        for (const double turn : {0.0, 17.0, 25.0})
            for (const char* first : {"a", "b"}) {
                const auto objects = [&](double up) {
                    const bool is_a = first == std::string("a");
                    return fmt::format(
                        R"({{"model": "a", "material": "red", "position": [0, {}, 0], "priority": {}}},
                           {{"model": "b", "material": "green", "position": [0.1, {}, 0.05],
                             "turn": [{}, 0, 0], "priority": {}}})",
                        0.21 + (is_a ? up : 0), is_a ? 1 : 0, 0.21 + (is_a ? 0 : up), turn,
                        is_a ? 0 : 1);
                };
                const Image flush = picture_of(objects(0), meshes),
                            above = picture_of(objects(kMovedBy), meshes);
                EXPECT_LT(pixels_that_differ(flush, above), kMaxAtEdges)
                    << "meshes: " << meshes << ", turned by " << turn << ", first: " << first;
            }
}

TEST_F(Coincident, BallsInOnePlaceAreTheFirstOne) {
    const char* one = R"({"model": "ball", "material": "red", "position": [0, 0.4, 0]})";
    const Image both = picture_of(
        fmt::format(R"({}, {{"model": "ball", "material": "green", "position": [0, 0.4, 0],
                             "turn": [30, 20, 10]}})",
                    one));
    EXPECT_EQ(pixels_that_differ(both, picture_of(one)), 0);
}

TEST_F(Coincident, WhatLetsLightThroughStandsOnATable) {
    for (const bool meshes : {false, true})
        for (const char* material : {"veil", "glass"})
            for (const char* model : {"can", "block"})
                for (const bool floor_is_last : {false, true}) {
                    const auto objects = [&](double down) {
                        const std::string table =
                            R"({"model": "floor", "material": "red", "position": [0, -0.1, 0]})";
                        const std::string thing = fmt::format(
                            R"({{"model": "{}", "material": "{}", "position": [0, {}, 0],
                                 "turn": [20, 0, 0]}})",
                            model, material, 0.25 - down);
                        return floor_is_last ? thing + ", " + table : table + ", " + thing;
                    };
                    const Image standing = picture_of(objects(0), meshes),
                                sunk = picture_of(objects(kMovedBy), meshes);
                    EXPECT_LT(pixels_that_differ(standing, sunk), 2 * kMaxAtEdges)
                        << "meshes: " << meshes << ", " << model << " of " << material
                        << ", floor last: " << floor_is_last;
                }
}

TEST_F(Coincident, BlocksOfGlassSideBySideTouch) {
    for (const bool meshes : {false, true})
        for (const double turn : {0.7, -0.9}) {
            const auto objects = [](double beyond) {
                return fmt::format(
                    R"({{"model": "floor", "material": "red", "position": [0, -0.11, 0]}},
                       {{"model": "block", "material": "glass", "position": [{}, 0.25, 0]}},
                       {{"model": "block", "material": "water", "position": [0.2, 0.25, 0]}})",
                    -0.2 + beyond);
            };
            const Image touching = picture_of(objects(0), meshes, turn),
                        overlapping = picture_of(objects(kMovedBy), meshes, turn);
            EXPECT_LT(pixels_that_differ(touching, overlapping), 3 * kMaxAtEdges)
                << "meshes: " << meshes << ", from " << turn;
        }
}

TEST_F(Coincident, ASolidOfTwoIsMetAsOneIs) {
    // The second block is what a block and a larger one have in common.
    const auto objects = [](const char* second) {
        return fmt::format(
            R"({{"model": "floor", "material": "red", "position": [0, -0.1, 0]}},
               {{"model": "block", "material": "glass", "position": [-0.2, 0.25, 0]}},
               {{"model": "{}", "material": "water", "position": [0.2, 0.25, 0]}},
               {{"model": "{}", "material": "veil", "position": [0.2, 0.75, 0]}})",
            second, second);
    };
    EXPECT_EQ(pixels_that_differ(picture_of(objects("block")), picture_of(objects("common"))), 0);
}

TEST_F(Coincident, SheetsInOnePlaceCoverTogether) {
    lights_ = "";  // in whose light one sheet would lie in the other's shadow
    Mesh sheet;
    sheet.positions = {{-0.4f, 0, -0.4f}, {-0.4f, 0, 0.4f}, {0.4f, 0, 0.4f}, {0.4f, 0, -0.4f}};
    for (const bool up : {true, false}) {
        sheet.triangles = up ? std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}
                             : std::vector<glm::uvec3>{{0, 2, 1}, {0, 3, 2}};
        write_obj(folder / "sheet.obj", sheet);
        const auto objects = [](double down) {
            return fmt::format(
                R"({{"model": "floor", "material": "red", "position": [0, -0.11, 0]}},
                   {{"model": "sheet", "material": "veil", "position": [0, 0.3, 0], "turn": [12, 5, 8]}},
                   {{"model": "sheet", "material": "veil", "position": [0, {}, 0], "turn": [12, 5, 8]}})",
                0.3 - down);
        };
        EXPECT_LT(pixels_that_differ(picture_of(objects(0)), picture_of(objects(kMovedBy))),
                  2 * kMaxAtEdges)
            << "face up: " << up;
    }
}

TEST_F(Coincident, WaterStandsOnGlass) {
    const auto objects = [](double down) {
        return fmt::format(
            R"({{"model": "floor", "material": "red", "position": [0, -0.11, 0]}},
               {{"model": "block", "material": "glass", "position": [0, 0.25, 0], "priority": 1}},
               {{"model": "drum", "material": "water", "position": [0, {}, 0]}})",
            0.65 - down);
    };
    const Image standing = picture_of(objects(0)), sunk = picture_of(objects(kMovedBy));
    EXPECT_LT(pixels_that_differ(standing, sunk), 2 * kMaxAtEdges);
}

}  // namespace
}  // namespace voxelume
