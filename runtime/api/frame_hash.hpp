// SPDX-License-Identifier: Apache-2.0
// What a frame's files are made from, as a hash.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "runtime/io/image/image_format_table.hpp"
#include "runtime/voxelume/image.hpp"
#include "runtime/voxelume/scene.hpp"

namespace voxelume::api {

/// The hashes of a scene's frames, with every file read once.
class FrameHashes {
  public:
    explicit FrameHashes(const v1::Scene& scene) : scene_(scene) {}

    /// Returns a hash of 32 hexadecimal digits over the version, the scene, its settings, and the
    /// bytes of all files that the frame shows, with those that they lead to. Throws Error::scene
    /// as `scene_at` does.
    std::string of(int frame) { return hash(frame, false); }
    /// Hashes what the frame's volumetric image shows, in which a crop of the picture doesn't
    /// count.
    std::string of_volume(int frame) { return hash(frame, true); }

  private:
    std::string hash(int frame, bool is_of_volume);

    v1::Scene scene_;
    std::map<std::filesystem::path, std::string> files_;
};

/// The hash of a frame's image file: of the frame's hash and the options that change a file of that
/// format.
std::string hash_for_image(const std::string& hash, const ImageFormatEntry& format,
                           const v1::ImageFileOptions& options);

}  // namespace voxelume::api
