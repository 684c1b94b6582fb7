// SPDX-License-Identifier: Apache-2.0
// Pictures whose bits are known: what a device's kernels make of them, for `doctor`.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// A scene, and the hash of all that is rendered of it, on any device.
struct KnownPicture {
    std::string_view name;
    std::string scene;       ///< JSON
    bool is_volume = false;  ///< its volumetric image
    std::string_view hash;   ///< 16 hexadecimal digits
};

/// Together they launch most kernels: not those for meshes, files of densities and beams.
std::vector<KnownPicture> known_pictures();

/// What came of one.
struct PictureResult {
    std::string hash;
    std::vector<std::string> kernels;  ///< that were launched
};

/// Renders it, without the cache of models and worlds. `launches` counts those of each kernel since
/// the device was opened. Throws Error as render_image does.
PictureResult render_known(const KnownPicture& picture, const Device& device,
                           std::map<std::string, uint64_t>& launches);

}  // namespace voxelume::cli
