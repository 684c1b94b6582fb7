// SPDX-License-Identifier: Apache-2.0
// frames of a scene -> those whose memory is estimated
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The maximum numbers of frames that are planned: of an animation, without those that show
/// something first, and of those at the keys of tracks.
inline constexpr size_t kMaxPlannedFrames = 2048, kMaxPlannedKeys = 1024;

struct FramesToPlan {
    std::vector<int> changed;  ///< frames whose plans may differ from those of the frames before
    std::vector<size_t>
        chosen;       ///< ascending indices into `changed`; all of them unless they are many
    size_t step = 1;  ///< the largest distance between neighbours in `chosen`
};

/// True if both frames have the same plan, since nothing that it depends on changed. Lights matter
/// only by whether they shine. The observer matters only in images without colour, whose rays are
/// followed through surfaces that the observer may be behind.
bool is_planned_like(const Scene& a, const Scene& b);

/// Chooses among `frames`. Up to kMaxPlannedFrames frames are all chosen without checks. If there
/// are more, each is checked against the rules for values and placements. Chosen are the frames at
/// the keys of tracks or, if these are more than kMaxPlannedKeys, at each track's extreme values
/// and some other keys; then others at even distances, and all that show an object or a file first.
/// Calls `progress`, unless it is empty, with the number of frames seen.
///
/// Throws as scene_at and check_placements do, with the frame.
FramesToPlan frames_to_plan(const Scene& scene, std::span<const int> frames,
                            const std::function<void(size_t)>& progress = {});

}  // namespace voxelume
