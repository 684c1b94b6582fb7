// SPDX-License-Identifier: Apache-2.0
// Scene -> images and volumetric images, in memory or as files, of one frame or many.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "device.hpp"
#include "image.hpp"
#include "process.hpp"
#include "quilt.hpp"
#include "scene.hpp"
#include "statistics.hpp"
#include "volume.hpp"
#include "warning.hpp"

namespace voxelume::v1 {

/// The options of rendering frames.
struct RenderOptions {
    Channels channels{};        ///< channels of images in memory
    CacheOptions cache{};       ///< cache of models and worlds on disk
    bool overlap = true;        ///< true: one device works on the next frame meanwhile
    bool time_kernels = false;  ///< true: fills Statistics::kernel_ms, which costs a little time
    /// Called with the share of the whole call that is done, from 0 to 1, never decreasing, and the
    /// number of the frame that got on; by one thread at a time, perhaps not the caller's. What it
    /// throws ends the call.
    std::function<void(double done, int frame)> progress{};
    /// Called with each warning, once: before the first frame is rendered for those that need no
    /// rendering, after the last frame for the others; by the thread that called. What it throws
    /// ends the call. Without it they are in Statistics::warnings alone.
    std::function<void(const Warning&)> warn{};
    /// True if warnings end the call: it then throws Error::scene with the first one's sentence,
    /// after `warn` had those that were found with it.
    bool strict = false;
    /// True if other calls render other frames of the run. Warnings of what none of the frames
    /// shows are then left out, as they are for an image cut by Scene::with_crop.
    bool is_part = false;
    /// Called before each kernel that no earlier run compiled is first launched: the `kernel`-th of
    /// `known` such kernels so far. It is called by one thread at a time, perhaps not the caller's.
    /// What it throws ends the call.
    std::function<void(int kernel, int known)> compiling{};
    /// Asks the call to end: it then throws Error::cancelled within about a batch of rays. Frames
    /// that were complete have been delivered.
    std::stop_token stop{};
};

/// Renders the image of a frame. Several devices share its tiles, and the bits are those of one.
///
/// `statistics`, where there is some, is filled. Throws Error::limit before memory is taken when
/// the frame doesn't fit, Error::usage for no device, Error::cancelled, and Error as `Scene::load`
/// does for values and files that are wrong at that frame.
Image render_image(const Scene& scene, const std::vector<Device>& devices, int frame = 1,
                   const RenderOptions& options = {}, Statistics* statistics = nullptr);

/// Renders the volumetric image of a frame's display. One device does it, the first. Throws as
/// render_image does.
Volume render_volume(const Scene& scene, const std::vector<Device>& devices, int frame = 1,
                     const RenderOptions& options = {}, Statistics* statistics = nullptr);

/// Renders a frame's views and lays them side by side: the leftmost at the bottom left, the
/// rightmost at the top right. The scene's image is the size of one. The observer needs a display
/// that is a pyramid. A target of noise counts for each view, and its seconds for all. Statistics,
/// where there are some, get those of all views added. Throws as render_image does, Error::usage
/// for other quilts or observers, and Error::limit, before memory is taken, where main memory has
/// no room for all views.
Image render_quilt(const Scene& scene, const std::vector<Device>& devices, const Quilt& quilt,
                   int frame = 1, const RenderOptions& options = {},
                   Statistics* statistics = nullptr);

/// The views of a quilt as images of their own, from left to right. Throws as render_quilt does.
std::vector<Image> render_views(const Scene& scene, const std::vector<Device>& devices,
                                const Quilt& quilt, int frame = 1,
                                const RenderOptions& options = {},
                                Statistics* statistics = nullptr);

/// The image that render_quilt makes of the views of render_views. Throws Error::usage for other
/// numbers or sizes of images, and Error::limit where main memory has no room for it.
Image join_views(const std::vector<Image>& views, const Quilt& quilt);

/// A frame that was rendered. Results that the job doesn't ask for are empty.
struct RenderedFrame {
    int frame = 1;                   ///< its number
    std::optional<Image> image{};    ///< empty if none was asked for, or it was written in bands
    std::optional<Volume> volume{};  ///< empty if none was asked for
    FrameStatistics statistics{};    ///< statistics of this frame
};

/// A frame to be rendered, and the files to be written of it: images .exr and .png, and volumetric
/// images of every VolumeFormat.
struct FrameFiles {
    int frame = 1;                                 ///< its number
    std::vector<std::filesystem::path> images{};   ///< files of images, .exr and .png
    std::vector<std::filesystem::path> volumes{};  ///< files in any format of volumes
    /// The frame's OpenEXR file of an earlier job that differed only in its number of samples, 1,
    /// 2, 4, 8, ... and fewer than now, and in its devices. These samples aren't rendered again,
    /// and the image has the same bits as with all samples in one job. The file needs `float_color`
    /// and only channels of colour, geometry and numbers. Empty: there is none.
    std::filesystem::path earlier{};
};

/// Frames to be rendered, and the use of the results.
struct FrameJob {
    std::vector<FrameFiles> frames{};  ///< frames in the order of delivery; one or more
    ImageFileOptions image_files{};    ///< how images are written
    /// Called with each frame, in order, after its files were written; by the thread that called
    /// render_frames. What it throws ends the call.
    std::function<void(const RenderedFrame&)> deliver{};
    bool deliver_images = false;   ///< true: `deliver` wants the images in memory
    bool deliver_volumes = false;  ///< true: `deliver` wants the volumetric images in memory
};

/// The channels of images that render_frames computes for a job: those that some file or `deliver`
/// shows. A job without either stands for the OpenEXR files of its options.
Channels needed_channels(const FrameJob& job, const RenderOptions& options = {});

/// Hashes of everything from which frames are made, 32 hexadecimal digits each: of the library's
/// version, of the scene with its size, samples, light and crop, and of the bytes of all files that
/// the frame shows, with those that they lead to. render_frames writes them, for images with the
/// options of their files, into files of formats that have room for a text in their headers (.exr,
/// .png, .nrrd, .vdb, .ply), with a hash of all their bytes.
std::vector<std::string> frame_hashes(const Scene& scene, const std::vector<int>& frames);

/// The hashes of a frame's views, from left to right. Throws as render_views does.
std::vector<std::string> view_hashes(const Scene& scene, const Quilt& quilt, int frame = 1);

/// The hash of the image that join_views makes of views with these hashes.
std::string quilt_hash(const std::vector<std::string>& views, const Quilt& quilt);

/// The hashes of the frames' volumetric images, which are whole where the scene has a crop.
std::vector<std::string> volume_hashes(const Scene& scene, const std::vector<int>& frames);

/// The state of a frame's file that was written before.
enum class FrameFileState {
    missing,  ///< there is no file
    damaged,  ///< the file isn't as it was written, or its format has no room for a hash
    stale,    ///< the file was made from something else
    current   ///< the file is whole, and equals what would be rendered
};

/// Reads the file of a frame's image, .png or .exr, and compares it with the frame's hash and the
/// options that change such a file.
FrameFileState image_file_state(const std::filesystem::path& file, const std::string& hash,
                                const ImageFileOptions& options = {});

/// Reads the file of a frame's volumetric image and compares it with the frame's hash, of
/// volume_hashes.
FrameFileState volume_file_state(const std::filesystem::path& file, const std::string& hash);

/// Joins the OpenEXR files of an image's parts and writes the image to `files`, .exr or .png, with
/// the bytes that render_frames writes for the whole image.
///
/// The parts are those of Scene::with_crop, whole rows one below the other in any order, written
/// with `float_color` and with all channels that `files` need. `hash` is that of the whole frame,
/// of frame_hashes. Throws Error::input for rows that two parts have or that none has, and for
/// parts of different images; Error as Image::read and Image::write do.
void merge_image_files(const std::vector<std::filesystem::path>& parts,
                       const std::vector<std::filesystem::path>& files, const std::string& hash,
                       const ImageFileOptions& options = {});

/// Renders frames of a scene. What a frame shows doesn't depend on the frames before it, nor on the
/// number of devices: several devices take a frame each, or the tiles of a job's only image.
///
/// Images that are larger than memory are rendered and written in bands of rows, unless `deliver`
/// wants them, a time is their target, or samples are added to them: then they are refused. Their
/// RenderedFrame has no image.
///
/// Throws as render_image does, and as Image::write and Volume::write do; frames before the one
/// that failed are written and delivered. Before any frame is rendered it throws Error::input for
/// `earlier` files that are damaged or of something else, and Error::usage for jobs that can't add
/// to them.
Statistics render_frames(const Scene& scene, const std::vector<Device>& devices,
                         const FrameJob& job, const RenderOptions& options = {});

}  // namespace voxelume::v1
