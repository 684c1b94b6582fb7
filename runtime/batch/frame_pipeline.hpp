// frames -> files: the next frame's world is formed and the last one's files are written while a
// frame is rendered.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "runtime/render/renderer.hpp"

namespace voxelume {

/// A frame that is ready to be rendered.
struct FrameInput {
    size_t frame = 0;   ///< its place in the run
    size_t device = 0;  ///< the number of the device that has its world
    const Scene& scene;
    const BuiltWorld& world;
    const WorldReport& report;  ///< of forming the world
};

/// What is done with each frame of a run, by its place in it. On one device all is done in order;
/// of several devices each has a thread, and frames of its own in order.
struct FrameSteps {
    /// The scene to show. Called by one thread at a time.
    std::function<Scene(size_t)> scene;
    /// Renders it. What it returns writes the files, by one thread, in order.
    std::function<std::function<void()>(const FrameInput&)> render;
    /// The number by which errors of forming its world name a frame. Without it they don't.
    std::function<double(size_t)> number = {};
    /// Which models a frame after this one shows; without it none is waited for.
    std::function<std::vector<bool>(size_t)> retained = {};
    /// Frees what `render` keeps on a device, by its number, for frames that follow. Without it no
    /// frame is tried again when memory lacks.
    std::function<void(size_t)> forget = {};
};

struct FrameOptions {
    bool overlap = true;  ///< of one device: three threads work on up to three frames, no more
    AssetStore meshes = AssetStore();  ///< what was read already, and the cache of models
};

/// Takes `count` frames through their steps. The files are the same with all options.
///
/// Frames overlap as long as the device has the memory for two. From the first on that it hasn't,
/// they are taken one at a time, so that each that fits alone is rendered. Returns that frame's
/// place in the run, where there was one.
///
/// Rethrows the first error of the frames in order, once the frames before it are written.
std::optional<size_t> run_frames(const std::vector<Device>& devices, size_t count,
                                 const FrameSteps& steps, FrameOptions options);

}  // namespace voxelume
