// SPDX-License-Identifier: Apache-2.0
// A block of glass cubes above a checkered floor. The tests of glass cubes share it, and so the
// programs that render it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume::glass_block {

inline constexpr const char* kColors[] = {"R", "G", "B"};

inline Image picture_of(const std::string& text, int lanes = 0, uint64_t* secondary_rays = nullptr,
                        const std::filesystem::path& folder = {}) {
    RenderReport report;
    Image image = render(test_device(lanes), parse_scene(text, "test.json", {folder, {}}), report);
    EXPECT_EQ(report.not_finite, 0u);
    if (secondary_rays) *secondary_rays = report.secondary_rays;
    return image;
}

/// Materials that every scene here has, out of sight, so that the same programs render all scenes.
inline constexpr const char* kMaterials =
    R"("all": {"refraction": 1, "opacity": 0.5, "absorption": [1, 1, 1], "checker": {"size": 0.3}})";
inline constexpr const char* kModels =
    R"("far cube": {"shape": "box", "size": [0.4, 0.4, 0.4], "surface": "cubes", "set": "solid"},
           "far ball": {"shape": "sphere", "radius": 0.3, "surface": "smooth"})";

inline constexpr const char* kFromAbove = R"("position": [0.9, 5, -1.7], "look_at": [0, 0.5, 0],
              "display": {"shape": "pyramid", "angle": 20})";
/// An observer with parallel rays along X, through 30 voxels of the block.
inline constexpr const char* kThrough = R"("position": [-6, 0.07, 0.03], "look_at": [0, 0.07, 0.03],
              "display": {"shape": "box", "size": [0.8, 0.6, 12]})";
inline constexpr const char* kBlock =
    R"({"model": "block", "material": "m", "position": [0.0625, 0.0625, 0.0625]}, )";

/// A world of 48 x 40 x 56 voxels of 0.125 m around objects, by default one solid block of 30 x 8 x
/// 22 voxels whose top face is at y = 0.5. `floor` is the floor's height.
inline std::string block_scene(const std::string& material, double floor = -2,
                               const std::string& observer = kFromAbove,
                               const std::string& block = kBlock) {
    return R"({"voxelume": 1,
"world": {"voxel_size": 0.125, "bounds": {"min": [-3, -2.5, -3.5], "max": [3, 2.5, 3.5]},
          "background": [0.25, 0.5, 0.75], "ambient": [0.1, 0.2, 0.3]},
"materials": {"m": )" +
           material +
           R"(, "floor": {"color": [0.9, 0.2, 0.1], "checker": {"color": [0.9, 0.9, 0.9], "size": 0.3}},
              )" +
           kMaterials + R"(},
"models": {"block": {"shape": "box", "size": [3.8, 1.1, 2.8], "surface": "cubes", "set": "solid"},
           "floor": {"shape": "box", "size": [5.7, 0.2, 6.7], "surface": "cubes"},
           )" +
           kModels + R"(},
"objects": [)" +
           block + R"({"model": "floor", "material": "floor", "position": [0, )" +
           std::to_string(floor) +
           R"(, 0]},
            {"model": "far ball", "material": "all", "position": [2.6, 2.1, 3.1]},
            {"model": "far cube", "material": "all", "position": [2.6, 1.3, 3.1]}],
"lights": [{"type": "point", "position": [0.3, 2.2, -2.1], "intensity": 3}],
"observer": {)" +
           observer + R"(},
"render": {"size": [16, 12], "shadow": "filtered"}})";
}

}  // namespace voxelume::glass_block
