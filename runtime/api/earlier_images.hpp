// SPDX-License-Identifier: Apache-2.0
// The files of images to which samples are added.
#pragma once

#include <filesystem>
#include <map>

#include "runtime/api/border/handles.hpp"
#include "runtime/batch/render_frames.hpp"
#include "runtime/voxelume/render.hpp"

namespace voxelume::api {

/// The texts for the header of an image of this scene that tell which samples are missing. Empty
/// for adaptive sampling, where pixels get more samples by their contrast with others.
Attributes sampling_texts(const Scene& scene);

/// The files of a job's frames that were rendered with fewer samples.
class EarlierFiles {
  public:
    /// Checks each file. Throws Error::usage for jobs that can't add samples with the bits of one
    /// run, Error::input for files that weren't written by such a job with fewer samples, a power
    /// of two, or more noise.
    EarlierFiles(const v1::Scene& scene, const v1::FrameJob& job, const v1::Channels& channels);

    /// The earlier images of frames; empty if no frame has one.
    EarlierImages images() const;

  private:
    struct File {
        std::filesystem::path path;
        int samples = 1;
    };
    std::map<int, File> files_;  ///< by their frames' numbers
};

}  // namespace voxelume::api
