// SPDX-License-Identifier: Apache-2.0
// What rendering for callers shares with planning and statistics.
#pragma once

#include <span>

#include "runtime/batch/render_frames.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/voxelume/image.hpp"
#include "runtime/voxelume/quilt.hpp"
#include "runtime/voxelume/statistics.hpp"

namespace voxelume::api {

/// The channels to render for these channels; motion is found from points and objects.
inline ImageChannels inside(const v1::Channels& channels) {
    return {.color = channels.color,
            .depth = channels.depth,
            .position = channels.position || channels.motion,
            .normal = channels.normal,
            .object = channels.object || channels.motion,
            .distance = channels.distance,
            .material = channels.material,
            .object_matte = channels.object_matte,
            .material_matte = channels.material_matte,
            .albedo = channels.albedo,
            .direct = channels.direct,
            .indirect = channels.indirect,
            .shadow = channels.shadow,
            .light_groups = channels.light_groups,
            .samples = channels.samples,
            .noise = channels.noise,
            .variance = channels.variance};
}

/// The statistics of one frame.
v1::FrameStatistics statistics_of(const FrameReport& frame);

/// The statistics of a run of frames on its devices, without its files and seconds.
v1::Statistics statistics_of(std::span<const FrameReport> frames, std::span<const Device> devices);

/// Throws what v1::render_quilt would throw for the frame's observer before it renders a view.
void check_quilt(const Scene& scene, const v1::Quilt& quilt, int frame);

}  // namespace voxelume::api
