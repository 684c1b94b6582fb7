// SPDX-License-Identifier: Apache-2.0
// Scenes of one object in worlds of any voxel size, and the loss of accuracy allowed to finer ones.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/support/solid_errors.hpp"

namespace voxelume {

inline constexpr glm::ivec2 kRefinedSize(240, 180);

/// A scene with one model "m" and `objects`, in a world with voxels of this size.
inline Scene refined_scene(const std::string& model, const std::string& objects, double voxel,
                           glm::ivec2 size = kRefinedSize,
                           const std::filesystem::path& folder = {}) {
    const std::string text = fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": {}, "bounds": {{"min": [-0.41, -0.4, -0.42], "max": [0.4, 0.41, 0.4]}}}},
"models": {{"m": {{{}}}}},
"objects": [{}],
"observer": {{"position": [0.4, 0.5, -1.1], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angle": 28}}}},
"render": {{"size": [{}, {}], "shadows": false}}}})",
                                         voxel, model, objects, size.x, size.y);
    return parse_scene(text, folder / "test.json", {});
}

inline Image refined_image(const Scene& scene) {
    RenderReport report;
    Image image = render(shared_device(), scene, report);
    EXPECT_EQ(report.not_finite, 0u);
    return image;
}

/// Expects that the errors of a finer model or world are at most 5 % larger, or within rounding.
inline void expect_no_worse(const SolidErrors& finer, const SolidErrors& coarser,
                            const std::string& at) {
    constexpr double kMore = 1.05, kDepth = 2e-6, kNormal = 0.02;
    constexpr size_t kPixels = 2;
    EXPECT_LE(finer.depth_rms, std::max(kMore * coarser.depth_rms, kDepth)) << at;
    EXPECT_LE(finer.normal_rms, std::max(kMore * coarser.normal_rms, kNormal)) << at;
    EXPECT_LE(double(finer.silhouette), kMore * double(coarser.silhouette) + double(kPixels)) << at;
    std::string key = at;
    std::erase(key, '"');  // GoogleTest writes it to JSON unescaped
    testing::Test::RecordProperty(
        key, fmt::format("depth {:.3g} m, normal {:.3g} degrees, silhouette {}", finer.depth_rms,
                         finer.normal_rms, finer.silhouette));
}

inline constexpr const char* kRefinedPlace =
    R"({"model": "m", "position": [0.013, -0.021, 0.007], "turn": [17, 31, 8]})";

/// The values first, 2 first ... up to `usual` or, in an exhaustive run, up to `all`.
inline std::vector<int> doubled_up_to(int first, int usual, int all) {
    std::vector<int> values;
    for (int value = first; value <= (is_exhaustive() ? all : usual); value *= 2)
        values.push_back(value);
    return values;
}

}  // namespace voxelume
