// SPDX-License-Identifier: Apache-2.0
// Shipped scenes, made small enough for tests.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/scene/scene.hpp"
#include "runtime/scene_file/assets.hpp"
#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {

inline const std::filesystem::path kScenes = std::filesystem::path(VXL_SOURCE_DIR) / "scenes";

/// The names of all shipped scenes.
inline std::vector<std::string> shipped_scenes() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(kScenes)) {
        const std::filesystem::path& file = entry.path();
        if (file.extension() == ".json" && file.stem().extension() != ".schema")
            names.push_back(file.stem());
    }
    std::ranges::sort(names);
    return names;
}

/// Enlarges the world's voxels until none of its axes has more than `maximum`, and the models' own
/// voxels with them.
inline void coarsen(Scene& scene, double maximum) {
    const int longest =
        std::max({scene.world.voxels.x, scene.world.voxels.y, scene.world.voxels.z});
    const double factor = std::max(1.0, longest / maximum);
    scene.world.voxel_size *= factor;
    scene.world.voxels = glm::ivec3(glm::ceil(glm::dvec3(scene.world.voxels) / factor));
    for (Model& model : scene.models) {
        model.voxel_size *= factor;
        if (model.resolution > 0) model.resolution = int(model.resolution / factor) + 1;
    }
}

/// The scene of that name in scenes/, with an image of `size` and at most `voxels` along an axis.
inline Scene small_scene(const std::string& name, glm::ivec2 size, double voxels) {
    const AssetFolders assets{"/usr/share/glmark2/models"};  // Debian's glmark2-data
    Scene scene = read_scene(kScenes / (name + ".json"), assets);
    resize(scene, size);
    scene.render.samples = 1;
    coarsen(scene, voxels);
    return scene;
}

}  // namespace voxelume
