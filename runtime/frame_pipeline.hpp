// frames -> files: the next frame's world is formed and the last one's files are written while a
// frame is rendered.
#pragma once

#include <functional>

#include "runtime/renderer.hpp"

namespace voxelume {

/// What is done with each frame of a run, by its place in it.
struct FrameSteps {
    /// The scene to show. Called in order, by one thread.
    std::function<Scene(size_t)> scene;
    /// Renders it; `report` says what forming its world took. Called in order, by the caller's
    /// thread. What it returns writes the files, by a third thread, in order.
    std::function<std::function<void()>(size_t, const Scene&, const FormedWorld&,
                                        const WorldReport& report)>
        render;
};

struct FrameOptions {
    bool overlap = true;  ///< three threads work on up to three frames, no more
    ModelCache cache;     ///< of models that need no voxelizing
};

/// Takes `count` frames through their steps. The files are the same with all options.
///
/// Rethrows the first error of the frames in order, once the frames before it are written.
void run_frames(const Device& device, size_t count, const FrameSteps& steps,
                const FrameOptions& options);

}  // namespace voxelume
