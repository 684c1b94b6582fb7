// SPDX-License-Identifier: Apache-2.0
// The room in which a file's content is shown: a ground without a visible end, a sun and a sky.
#pragma once

#include <string>
#include <vector>

#include "runtime/import/file_light.hpp"
#include "runtime/import/import_options.hpp"

namespace voxelume {

struct Studio {
    std::vector<std::string> materials, models, objects, lights;  ///< members and items of a scene
    glm::dvec3 background{0};
    glm::dvec3 ambient{0};
    std::string sky, medium;  ///< `, "sky": {...}`, or empty
    Bounds box;               ///< around what is shown and the ground
};

/// A room for what fills `box` in a world with voxels of this size, without a ground where that
/// would be too large for the world. The sun comes from over the observer's left shoulder. Where
/// light falls on the ground without hindrance, the ground has the radiance of the background, so
/// that only shadows tell them apart. Light that the file has replaces the room's, and the ground
/// and background of the options replace the file's. `ambient` is added to the room's own light.
Studio make_studio(const Bounds& box, const glm::dvec3& voxel_size, const ViewFrom& from,
                   const ImportOptions& options, const std::optional<FileLight>& file_light,
                   double ambient);

}  // namespace voxelume
