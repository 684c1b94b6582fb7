// SPDX-License-Identifier: Apache-2.0
// frames of a scene -> images and volumetric images, on one device or several.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/base/warning.hpp"
#include "runtime/batch/banded_image.hpp"
#include "runtime/image/volume.hpp"
#include "runtime/render/renderer.hpp"

namespace voxelume {

/// Called with the fraction of the whole run that is done, which never decreases and ends with 1,
/// and the number of the frame that got on; by one thread at a time. It may throw, which fails that
/// frame.
using BatchProgress = std::function<void(double done, int frame)>;

/// Called with warnings that differ in subject: before the first frame with those that need no
/// rendering, after the last one with the others. It may throw, which ends the run.
using BatchWarnings = std::function<void(std::span<const Warning>)>;

/// The image of a frame's samples before others are added to them.
struct EarlierImage {
    std::shared_ptr<const Image> image;
    int samples = 1;  ///< a power of two, less than the scene's; 0: as its channels say
};
/// Gives a frame's earlier image by the frame's number. Several threads call it.
using EarlierImages = std::function<EarlierImage(int frame)>;

/// Makes the sink for the bands of a frame's image, by the frame's number `n` in the run, from 0.
/// Several threads call it.
using BandSinks = std::function<std::shared_ptr<BandSink>(size_t n)>;

/// The results to render of a scene.
struct BatchOptions {
    std::vector<int> frames = {1};  ///< their numbers, in the order of the results; one or more
    bool image = true;              ///< the observer's flat image of each frame
    bool volume = false;            ///< the volumetric image of each frame's display
    bool overlap = true;  ///< on one device, two worlds at a time; false: needs less memory
    AssetStore meshes = AssetStore();  ///< meshes that were read already, and the cache of models
    bool is_part = false;        ///< other runs render the other frames, so no warning says that
                                 ///< something is never shown
    EarlierImages earlier = {};  ///< empty: images have all samples
    BandSinks bands = {};        ///< empty: images that are larger than memory are refused
    BatchProgress progress = {};
    BatchWarnings warn = {};    ///< empty: no warnings are looked for
    std::stop_token stop = {};  ///< cancels the run
};

/// The report on one frame, and its device.
struct FrameReport {
    int frame = 1;
    size_t device = 0;  ///< index of the device; 0 where all devices share one image
    RenderReport report;
};

/// One frame, rendered. The caller may keep the pointers; frames that show the same share them.
struct FrameResult {
    FrameReport report;
    std::shared_ptr<const Image> image;  ///< null where none is asked for, or `bands` had it
    std::shared_ptr<BandSink> bands;     ///< sink that took the image, finished; null: it is whole
    ShownContent shown;                  ///< content of those bands
    std::shared_ptr<Volume> volume;  ///< null where none is asked for; its attributes may be set
};

/// Takes the results, in the order of the frames, on the thread that called `render_frames`.
using FrameOutput = std::function<void(const FrameResult&)>;

/// The outcome of a run.
struct BatchOutcome {
    size_t frames_done = 0;     ///< results that the output took
    bool is_cancelled = false;  ///< stopped before all frames were done
    int bands = 1;              ///< number of bands of each image
    double check_seconds = 0;   ///< seconds of culling and planning before the first frame
    /// The frame from which on nothing overlapped, because memory suffices for one world only.
    std::optional<int> one_by_one_from;
};

/// Renders frames of a scene and hands each to `output`. The bits don't depend on the options.
///
/// - One device overlaps frames: it builds the next world while it renders one and `output` takes
///   another. From the first frame on whose memory doesn't suffice for that, frames follow each
///   other one by one. Worlds, images and models that later frames show again are retained as long
///   as memory suffices.
/// - Several devices take a frame each, as they become free, and build its world themselves.
/// - Several devices share the tiles of an image that is the only result of the run.
/// - Images for which memory doesn't suffice are rendered in bands, in one world, and given to
///   `BatchOptions::bands`. Several devices take the bands of one that is the only result.
///
/// An error, of `output` too, ends the run once the frames before it were given to `output`; it is
/// thrown with the frame's number where the scene moves. Cancelling ends the run between two
/// batches of rays; frames that are not complete then are never given to `output`. Throws
/// Error::limit before any frame is rendered where a frame doesn't fit a device, and Error as the
/// stages do.
BatchOutcome render_frames(const std::vector<Device>& devices, Scene scene, BatchOptions options,
                           const FrameOutput& output);

}  // namespace voxelume
