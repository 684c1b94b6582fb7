// SPDX-License-Identifier: Apache-2.0
// A file -> the volumetric image that `view` shows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// A volumetric image, or a scene or a model file that a device makes one of.
struct ViewSource {
    std::string from;
    std::vector<std::filesystem::path> assets;  ///< folders of a scene's models
    std::string device;
};

/// The volumetric image of a file, or of what a scene or a model file holds. Throws Error as
/// reading and rendering do.
Volume volume_of(const ViewSource& source);

}  // namespace voxelume::cli
