// SPDX-License-Identifier: Apache-2.0
// What a frame's files are made from, as a hash.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "runtime/voxelume/image.hpp"
#include "runtime/voxelume/scene.hpp"

namespace voxelume::api {

/// The hashes of a scene's frames, with every file read once.
class FrameHashes {
  public:
    FrameHashes(const v1::Scene& scene, const v1::ImageFileOptions& options)
        : scene_(scene), options_(options) {}

    /// 32 hexadecimal digits: of the version, the scene, its settings, those of image files, and
    /// the bytes of all files that the frame shows, with those that they lead to. Throws
    /// Error::scene as `scene_at` does.
    std::string of(int frame);

  private:
    v1::Scene scene_;
    v1::ImageFileOptions options_;
    std::map<std::filesystem::path, std::string> files_;
};

}  // namespace voxelume::api
