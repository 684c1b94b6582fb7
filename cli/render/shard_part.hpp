// SPDX-License-Identifier: Apache-2.0
// Reduces a job of `render` to what one part of it renders, and writes the part's manifest.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/output/shard_manifest.hpp"
#include "cli/render/frame_files.hpp"

namespace voxelume::cli {

/// The part of a job that a command with --shard renders.
class ShardPart {
  public:
    /// Leaves this part's frames in `job`. For a single image, leaves this part's rows in `scene`,
    /// and the file for them in `job`. Leaves no frame if there is nothing for this part. Throws
    /// Error::usage for jobs that can't be divided.
    ShardPart(const RenderCommand& command, Scene& scene, FrameJob& job);

    /// Writes the manifest once the files exist. Throws Error::output.
    void write() const;

  private:
    void cut_image(const RenderCommand& command, Scene& scene, FrameJob& job);
    std::string name_of(const std::filesystem::path& file) const;
    ShardFile described(const std::filesystem::path& file) const;

    std::filesystem::path file_;  ///< the manifest
    ShardManifest manifest_;
    std::vector<FrameFiles> frames_;  ///< frames of this part
    std::filesystem::path rows_;      ///< the file of this part's rows
};

}  // namespace voxelume::cli
