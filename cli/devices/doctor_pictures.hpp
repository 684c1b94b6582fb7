// SPDX-License-Identifier: Apache-2.0
// Pictures whose bits are known: `doctor` compares them with what a device's kernels compute.
#pragma once

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/voxelume_verify.hpp"

namespace voxelume::cli {

/// A scene, and the hash of everything that is rendered of it, on any device.
struct KnownPicture {
    std::string_view name;
    std::string scene;       ///< JSON
    bool is_volume = false;  ///< hashes the volumetric image instead
    std::string_view hash;   ///< 16 hexadecimal digits, over all frames
};

/// The known pictures. Together they launch every kernel that images need.
std::vector<KnownPicture> known_pictures();

/// A file that the scenes of known pictures use.
struct KnownFile {
    std::string_view name;
    std::string text;
};

std::vector<KnownFile> known_files();

/// A folder with the files of the known pictures. Its last copy removes it.
class KnownFiles {
  public:
    /// Writes the files into a new temporary folder. Throws Error::output if that fails.
    KnownFiles();

    const std::filesystem::path& folder() const { return *folder_; }

  private:
    std::shared_ptr<const std::filesystem::path> folder_;
};

/// Renders all frames of a picture, without the cache of models and worlds, and returns their hash.
/// Throws the errors of render_frames.
std::string hash_of_render(const KnownPicture& picture, const KnownFiles& files,
                           const Device& device, const std::stop_token& stop);

}  // namespace voxelume::cli
