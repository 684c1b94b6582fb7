// SPDX-License-Identifier: Apache-2.0
// A promise of a device's memory held against what was taken of it, and a scene for that.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "runtime/opencl/device.hpp"
#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {

/// A promise below what is taken is broken; one far above it frightens off what fits.
inline constexpr double kMaxRatio = 1.3;

/// Prints a line of a table; with VXL_TEST_MEMORY the largest buffers, too.
inline void expect_kept(const std::string& name, double promise, const Device& device,
                        double max_ratio) {
    const auto fact = double(device.counters().peak_bytes);
    fmt::print("{:24} promised {:9.3f} MB, taken {:9.3f} MB, ratio {:.3f}\n", name, promise / 1e6,
               fact / 1e6, promise / fact);
    if (std::getenv("VXL_TEST_MEMORY"))
        for (const auto& [buffer, bytes] : device.counters().allocated_bytes)
            if (double(bytes) > 0.02 * fact)
                fmt::print("    {:24} {:9.3f} MB in all\n", buffer, double(bytes) / 1e6);
    EXPECT_GE(promise, fact) << name;
    EXPECT_LE(promise, max_ratio * fact) << name;
}

/// A ball before a wall, of such materials, in such a space.
inline Scene promise_room(const char* ball, const char* wall, const char* space, double voxel,
                          const char* surface = "smooth") {
    const std::string text = fmt::format(
        R"({{"voxelume": 1,
"world": {{"voxel_size": {}, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}}, {} "ambient": [0.1, 0.1, 0.1]}},
"materials": {{"ball": {{{}}}, "wall": {{{}}}}},
"models": {{"ball": {{"shape": "sphere", "radius": 0.5, "surface": "{}"}},
            "wall": {{"shape": "box", "size": [1.9, 1.8, 0.1], "surface": "smooth"}}}},
"objects": [{{"model": "ball", "material": "ball"}},
            {{"model": "wall", "material": "wall", "position": [0, 0, 0.9]}}],
"lights": [{{"type": "point", "position": [0.4, 0.9, -0.9]}}],
"observer": {{"position": [0.2, 0.4, -2.9], "look_at": [0, 0, 0], "display": {{"shape": "pyramid", "angles": [40, 40]}}}},
"render": {{"size": [200, 160], "depth": 3}}}})",
        voxel, space, ball, wall, surface);
    return parse_scene(text, "test.json", {});
}

}  // namespace voxelume
