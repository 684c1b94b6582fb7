// SPDX-License-Identifier: Apache-2.0
// frames -> outputs: which device builds and renders which frame, and when.
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "runtime/batch/frame_queue.hpp"
#include "runtime/render/moments.hpp"
#include "runtime/render/renderer.hpp"

namespace voxelume {

/// A frame that is ready to be rendered.
struct FrameInput {
    size_t frame = 0;   ///< its index in the run
    size_t device = 0;  ///< index of the device that has its world
    const Scene& scene;
    const BuiltWorld& world;    ///< the world of the moment that was built last
    const WorldReport& report;  ///< report on building the world, or the worlds of all moments
    const Moments* moments;     ///< null if the frame's samples show one moment
    std::stop_token stop;       ///< requested when the frame is not wanted any more
};

/// The actions for each frame of a run, by its index.
struct FrameSteps {
    /// The scene to show. Called by one thread at a time.
    std::function<Scene(size_t)> scene;
    /// Renders it, on a thread of the device. The output is called on the thread that called
    /// `run_frames`, in the order of the frames.
    std::function<OutputStep(const FrameInput&)> render;
    /// The number by which errors before the output name a frame. Without it they don't.
    std::function<double(size_t)> number = {};
    /// The models that a frame after this one shows; without this function none is retained.
    std::function<std::vector<bool>(size_t)> retained = {};
    /// Frees what `render` retains on a device, by its index, for frames that follow. Without it no
    /// frame is tried again when memory lacks.
    std::function<void(size_t)> forget = {};
    /// The scene when one of a frame's samples is taken. Called by one thread at a time.
    std::function<Scene(size_t, int sample)> moment = {};
    /// True if the samples of a frame's image show several moments; without it no frame's do.
    std::function<bool(size_t)> has_moments = {};
    /// Hears of an error at once, on a thread of the device.
    std::function<void()> failed = {};
};

struct ScheduleOptions {
    bool overlap = true;    ///< one device builds a world while it renders another
    bool one_each = false;  ///< true if each device renders the one frame of its own index
    AssetStore meshes = AssetStore();  ///< meshes that were read already, and the cache of models
    std::stop_token stop = {};         ///< cancels the run
};

struct ScheduleOutcome {
    size_t frames_done = 0;  ///< frames output: all, unless the run was cancelled
    /// The first frame that was rendered with no other world in memory, because memory ran short.
    std::optional<size_t> one_by_one_from;
};

/// Takes `count` frames through their steps. The outputs are the same with all options.
///
/// Each device has a thread, and several devices take frames as they become free, no more than two
/// for each beyond what is output. One device overlaps frames of one moment each as long as it has
/// the memory for two worlds; after that, frames follow each other one by one. An error is thrown
/// once the frames before it are output; frames that are being rendered then are told to stop.
ScheduleOutcome run_frames(const std::vector<Device>& devices, size_t count,
                           const FrameSteps& steps, ScheduleOptions options);

}  // namespace voxelume
