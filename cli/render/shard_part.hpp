// SPDX-License-Identifier: Apache-2.0
// A job of `render` -> what one part of it renders, and the manifest of that.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/output/shard_manifest.hpp"
#include "cli/render/frame_files.hpp"

namespace voxelume::cli {

/// What a command with --shard renders of its job.
class ShardPart {
  public:
    /// Leaves this part's frames in `job`, or its rows of the only image in `scene` and the file
    /// for them in `job`; no frame where there is nothing for this part. Throws Error::usage for
    /// jobs that can't be cut.
    ShardPart(const RenderCommand& command, Scene& scene, FrameJob& job);

    /// Writes the manifest, once the files are there. Throws Error::output.
    void write() const;

  private:
    void cut_image(const RenderCommand& command, Scene& scene, FrameJob& job);
    std::string name_of(const std::filesystem::path& file) const;
    ShardFile described(const std::filesystem::path& file) const;

    std::filesystem::path file_;  ///< of the manifest
    ShardManifest manifest_;
    std::vector<FrameFiles> frames_;  ///< of this part
    std::filesystem::path rows_;      ///< the file of its rows
};

}  // namespace voxelume::cli
