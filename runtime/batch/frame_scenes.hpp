// SPDX-License-Identifier: Apache-2.0
// A scene and numbers of frames -> the scenes that a run shows one after the other.
#pragma once

#include <vector>

#include "runtime/batch/frame_schedule.hpp"
#include "runtime/batch/render_frames.hpp"
#include "runtime/memory/image_bands.hpp"

namespace voxelume {

/// The sources of frames.
struct FrameSource {
    const Scene& scene;
    ImageBands bands;              ///< the bands in which images are rendered
    const EarlierImages& earlier;  ///< empty: images have all samples
};

/// The steps of a run that give the scenes of these frames. What `source` refers to must outlive
/// the steps. Each scene's image is the first of its bands, with only the samples that are missing.
FrameSteps steps_that_show(const FrameSource& source, std::vector<int> frames);

}  // namespace voxelume
