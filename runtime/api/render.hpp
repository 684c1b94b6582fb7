// SPDX-License-Identifier: Apache-2.0
// What rendering for callers shares with planning and statistics.
#pragma once

#include <span>

#include "runtime/batch/render_frames.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/voxelume/image.hpp"
#include "runtime/voxelume/statistics.hpp"

namespace voxelume::api {

inline ImageChannels inside(const v1::Channels& channels) {
    return {channels.color,    channels.depth,        channels.position,
            channels.normal,   channels.object,       channels.distance,
            channels.material, channels.object_matte, channels.material_matte};
}

/// What one frame took.
v1::FrameStatistics statistics_of(const FrameReport& frame);

/// What a run of frames took on its devices, without its files and seconds.
v1::Statistics statistics_of(std::span<const FrameReport> frames, std::span<const Device> devices);

}  // namespace voxelume::api
