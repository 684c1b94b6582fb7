// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace voxelume {

/// The folder with the shipped scenes, their schema and their manual.
inline const std::filesystem::path kScenes = std::filesystem::path(VXL_SOURCE_DIR) / "scenes";

/// The pages of the scenes' manual, one after another.
inline std::string manual_of_scenes() {
    std::ostringstream pages;
    for (const auto& entry : std::filesystem::directory_iterator(kScenes / "manual"))
        pages << std::ifstream(entry.path()).rdbuf();
    return pages.str();
}

/// A scene with the given members, on lines of their own from line 5 on.
inline std::string scene_with(const std::string& members) {
    return R"({"voxelume": 1,
"world": {"voxel_size": 0.5, "bounds": {"min": [-1, -2, -3], "max": [1, 2, 3]}},
"models": {"ball": {"shape": "sphere", "radius": 1, "surface": "smooth"}, "floor": {"shape": "slab", "thickness": 0.1, "surface": "smooth"}},
"materials": {"brick": {"color": [1, 0, 0]}, "glass": {"ior": 1.33}},
)" + members +
           R"(
"observer": {"position": [0, 0, -3], "display": {"shape": "pyramid"}}})";
}

}  // namespace voxelume
