// SPDX-License-Identifier: Apache-2.0
// Voxels in a caller's memory: a box of 7 x 5 x 3, seen along Z by parallel rays, one pixel per
// voxel. The picture shows the foremost voxel of each column.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "runtime/voxelume/files.hpp"
#include "runtime/voxelume/process.hpp"
#include "tests/api/api_fixture.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume::v1 {
namespace {

using testing::HasSubstr;

class ApiVoxels : public ApiTest {
  protected:
    RenderOptions quick{.cache = {.enabled = false}};
};

constexpr int kX = 7, kY = 5, kZ = 3;

/// An array with different voxels, about half of which are set.
struct Cells {
    std::vector<uint8_t> rgba = std::vector<uint8_t>(size_t(4) * kX * kY * kZ);

    Cells() {
        for (int z = 0; z < kZ; ++z)
            for (int y = 0; y < kY; ++y)
                for (int x = 0; x < kX; ++x) {
                    uint8_t* voxel = at(x, y, z);
                    voxel[0] = uint8_t(30 * x + 10);
                    voxel[1] = uint8_t(40 * y + 20);
                    voxel[2] = uint8_t(80 * z + 30);
                    voxel[3] = (x * 5 + y * 3 + z * 7) % 11 < 5 ? 255 : 0;
                }
    }
    uint8_t* at(int x, int y, int z) { return &rgba[size_t(4 * (x + kX * (y + kY * z)))]; }
    VoxelArray array() const {
        return {.name = "cells", .size = {kX, kY, kZ}, .rgba = rgba.data()};
    }
};

/// White light from everywhere on the model "cells", seen along -Z: column x, y is pixel x, 4 - y.
constexpr const char* kScene = R"({"voxelume": 1,
"world": {"voxel_size": 1, "bounds": {"min": [-2, -2, -2], "max": [9, 7, 5]},
          "background": [0, 0, 0], "ambient": [1, 1, 1]},
"materials": {"own": {"color": [1, 1, 1]}},
"models": {"cells": {"voxels": "cells"}},
"objects": [{"model": "cells", "material": "own"}],
"lights": [],
"observer": {"position": [3.5, 2.5, 5], "look_at": [3.5, 2.5, 0],
             "display": {"shape": "box", "size": [7, 5, 7]}},
"render": {"size": [7, 5]}})";

std::string message_of(const SceneOptions& options, const std::string& text = kScene) {
    try {
        Scene::parse(text, "scene", options);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_F(ApiVoxels, ShowTheirColoursWhereTheyAre) {
    Cells cells;
    const Scene scene = Scene::parse(kScene, "scene", {.voxels = {cells.array()}});
    const Image image = render_image(scene, *device, 1, quick);
    int shown = 0;
    for (int y = 0; y < kY; ++y)
        for (int x = 0; x < kX; ++x) {
            const size_t pixel = size_t(x + kX * (kY - 1 - y));
            int z = kZ - 1;
            while (z >= 0 && cells.at(x, y, z)[3] == 0) --z;
            SCOPED_TRACE(testing::Message() << "column " << x << ", " << y << " shows " << z);
            EXPECT_EQ(image.object_ids()[pixel], z < 0 ? 0u : 1u);
            if (z < 0) continue;
            ++shown;
            EXPECT_NEAR(image.plane("Z")[pixel], 4 - z, 1e-4);
            EXPECT_NEAR(image.plane("R")[pixel], linear_from_code(cells.at(x, y, z)[0]), 1e-3);
            EXPECT_NEAR(image.plane("G")[pixel], linear_from_code(cells.at(x, y, z)[1]), 1e-3);
            EXPECT_NEAR(image.plane("B")[pixel], linear_from_code(cells.at(x, y, z)[2]), 1e-3);
        }
    EXPECT_GT(shown, 20);
}

TEST_F(ApiVoxels, AreReadByStridesAndNotKept) {
    Cells cells;
    const Image expected =
        render_image(Scene::parse(kScene, "scene", {.voxels = {cells.array()}}), *device, 1, quick);
    // z fastest, and y from the top to the ground.
    std::vector<uint8_t> turned(cells.rgba.size());
    const auto at = [&](int x, int y, int z) {
        return &turned[size_t(4 * (z + kZ * ((kY - 1 - y) + kY * x)))];
    };
    for (int z = 0; z < kZ; ++z)
        for (int y = 0; y < kY; ++y)
            for (int x = 0; x < kX; ++x) std::copy_n(cells.at(x, y, z), 4, at(x, y, z));
    const VoxelArray array{"cells", {kX, kY, kZ}, at(0, 0, 0), {{4 * kZ * kY, -4 * kZ, 4}}};
    const Scene scene = Scene::parse(kScene, "scene", {.voxels = {array}});
    std::ranges::fill(turned, uint8_t(0));
    const Image image = render_image(scene, *device, 1, quick);
    for (const char* name : {"R", "G", "B", "Z"})
        EXPECT_TRUE(std::ranges::equal(image.plane(name), expected.plane(name))) << name;
    SceneDescription built;
    built.models = {{.name = "m", .source = VoxelFile{.file = "cells"}}};
    built.objects = {{.model = "m"}};
    EXPECT_EQ(Scene::build(built, {.voxels = {cells.array()}}).object_names().size(), 1u);
}

TEST_F(ApiVoxels, OfOtherColoursMakeFramesStale) {
    Cells cells;
    const auto hash = [&] {
        return frame_hashes(Scene::parse(kScene, "scene", {.voxels = {cells.array()}}), {1});
    };
    const std::vector<std::string> before = hash();
    EXPECT_EQ(hash(), before);
    cells.rgba[0] ^= 1;
    EXPECT_NE(hash(), before);
}

TEST_F(ApiVoxels, StandInAStudioByThemselves) {
    Cells cells;
    const Scene scene = scene_of_voxels(cells.array(), {.size = {40, 30}});
    const Image image = render_image(scene, *device, 1, quick);
    EXPECT_GT(std::ranges::count(image.object_ids(), 1u), 200);
    EXPECT_EQ(scene.object_names().at(0), "cells");
}

TEST_F(ApiVoxels, WithoutSenseAreErrors) {
    Cells cells;
    VoxelArray array = cells.array();
    EXPECT_EQ(message_of({.voxels = {array}}), "no error");
    EXPECT_THAT(message_of({.voxels = {array, array}}), HasSubstr("two arrays"));
    array.size = {7, 0, 3};
    EXPECT_THAT(message_of({.voxels = {array}}), HasSubstr("7 x 0 x 3 has no voxels"));
    array.size = {70000, 1, 1};
    EXPECT_THAT(message_of({.voxels = {array}}), HasSubstr("too large"));
    std::ranges::fill(cells.rgba, uint8_t(0));
    EXPECT_THAT(message_of({.voxels = {cells.array()}}), HasSubstr("all opacities are 0"));
    EXPECT_THAT(message_of({}), HasSubstr("there is no file \"cells\""));
    std::string smooth = kScene;
    smooth.replace(smooth.find("\"voxels\": \"cells\""), 17, "\"voxels\": \"cells\", \"part\": 1");
    cells = Cells();
    EXPECT_THAT(message_of({.voxels = {cells.array()}}, smooth), HasSubstr("are in memory"));
}

TEST_F(ApiVoxels, OfATextWithoutLinesAreNamedByTheirKeys) {
    const std::string text = R"({"voxelume": 1, "models": {"m": {"voxels": 3}}})";
    EXPECT_THAT(message_of({}, text), HasSubstr("scene:1:"));
    EXPECT_THAT(message_of({.has_lines = false}, text),
                testing::StartsWith("scene: models.m.voxels: "));
}

TEST_F(ApiVoxels, OfASceneAreCountedBeforeTheyAreRead) {
    const int side = is_exhaustive() ? 1600 : 1200;
    const Scene scene = Scene::parse(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 1, "bounds": {{"min": [0, 0, 0], "max": [{0}, 16, {0}]}}}},
"models": {{"floor": {{"shape": "box", "size": [{0}, 16, {0}], "surface": "cubes"}}}},
"objects": [{{"model": "floor", "position": [{1}, 8, {1}]}}]}})",
                                                 side, side / 2),
                                     "a.json", {.cache = {.enabled = false}});
    const auto message = [&](uint64_t bytes) -> std::string {
        limit_memory(bytes);
        try {
            voxelize_scene(scene, {folder / "a.vxm"}, device->front(), {});
        } catch (const Error& error) {
            limit_memory(0);
            return error.what();
        }
        limit_memory(0);
        return "no error";
    };
    EXPECT_EQ(message(uint64_t{4} << 30), "no error");
    std::filesystem::remove(folder / "a.vxm");
    EXPECT_THAT(message(is_exhaustive() ? 500'000'000 : 350'000'000),
                HasSubstr("as cubes of 1 m the scene needs "));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.vxm"));
}

}  // namespace voxelume::v1
