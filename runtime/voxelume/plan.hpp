// SPDX-License-Identifier: Apache-2.0
// Estimates of the memory for rendering a scene, before any is taken.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "device.hpp"
#include "error.hpp"
#include "image.hpp"
#include "process.hpp"
#include "quilt.hpp"
#include "scene.hpp"
#include "warning.hpp"

namespace voxelume::v1 {

/// The verdict on whether a frame fits a device.
enum class Verdict {
    fits,         ///< the maximum that it may take is available
    may_fit,      ///< the minimum is available, the maximum isn't
    does_not_fit  ///< the minimum isn't available, or a limit is exceeded
};

/// "fits", "may fit" or "doesn't fit".
const char* name_of(Verdict verdict);

/// One grid of voxels: that of a model, of one object alone, or of the world.
struct GridPlan {
    std::string name{};                   ///< "model NAME", "object NAME" or "world"
    std::array<int, 3> size{};            ///< voxels
    std::optional<uint64_t> triangles{};  ///< triangles of a mesh; the world has none of its own
    double surface_voxels = 0;            ///< voxels with a surface, estimated
    double bricks = 0;                    ///< bricks of 16 x 16 x 16 voxels with a surface in them
    double made_bytes = 0;                ///< bytes on the device while it is made
    double kept_bytes = 0;                ///< bytes on the device afterwards
    std::array<double, 3> voxel_size{};   ///< metres, in the space of the model or the world
    size_t instances = 0;                 ///< objects that show it as instances
};

/// The maximum memory of the device during a stage, with what earlier stages leave there.
struct StagePlan {
    std::string name{};  ///< "voxelize", "place", "index", "image" or "volume"
    double bytes = 0;    ///< bytes, at most
};

/// The surface that `auto` chooses for a model.
struct SurfacePlan {
    std::string model{};    ///< its name
    std::string surface{};  ///< "cubes", "smooth" or "exact"
    std::string reason{};   ///< half a sentence: "it is open at 12 edges"
};

/// Estimates for the frame that takes the most memory, or the first one that doesn't fit.
struct Plan {
    Verdict verdict = Verdict::fits;  ///< verdict on the frame that takes the most
    std::optional<Error> refusal{};   ///< why it doesn't fit: what is too large, and what to do
    int frame = 1;                    ///< frame that takes the most memory
    /// Number of planned frames, if too many frames change to plan all: frames are chosen at the
    /// tracks' keys, evenly between them, and around the largest. 0: all are planned.
    int chosen_frames = 0;
    int bands = 1;      ///< bands of rows in which each image is rendered to files; 1: it is whole
    int band_rows = 0;  ///< rows of each but perhaps the last; estimates are for such an image
    std::string device{};             ///< name of the device
    double min_bytes = 0;             ///< bytes of the device, at least
    double max_bytes = 0;             ///< bytes of the device, at most, for what the options want
    double device_bytes = 0;          ///< bytes of the device that can be used
    double largest_buffer_bytes = 0;  ///< bytes of the largest buffer of any stage
    double host_bytes = 0;            ///< bytes of main memory, besides the device's and the driver
    double views_bytes = 0;           ///< bytes of a quilt's views, part of host_bytes
    /// Bytes of main memory that the whole process takes, at most: the program, the OpenCL driver
    /// and its compiler, `host_bytes` and, on CPUs, what the device takes.
    double process_bytes = 0;
    std::vector<GridPlan> grids{};  ///< the grid of the world is the last
    /// The memory of each stage. The stages "image" and "volume", of flat and of volumetric images,
    /// only run if such images are asked for.
    std::vector<StagePlan> stages{};
    std::vector<Warning> warnings{};  ///< probable mistakes, as far as known without rendering
    /// The surfaces of models whose files decide them.
    std::vector<SurfacePlan> surfaces{};
};

/// The assumptions of a plan.
struct PlanOptions {
    std::vector<int> frames{};     ///< frames to plan; empty: all of the animation
    Channels channels{};           ///< channels of the images
    bool image = true;             ///< true: flat images are wanted
    bool volume = false;           ///< true: volumetric images are wanted
    std::optional<Quilt> quilt{};  ///< the image is a quilt, whose views main memory holds
    CacheOptions cache{};          ///< cache with known models, which needn't be read
    /// Called with the number of frames that are planned, and of all.
    std::function<void(size_t done, size_t frames)> progress{};
};

/// Plans frames of a scene on a device. Reads the meshes that they show; takes no memory of the
/// device.
///
/// Throws Error as `Scene::load` does for values that are wrong at a frame, as render_quilt does
/// for quilts that can't be rendered or kept, and Error::limit for lattices that can't be numbered
/// at all. A scene that merely doesn't fit has a plan like others.
Plan plan(const Scene& scene, const Device& device, const PlanOptions& options = {});

/// Plans frames for the device that Device::open would open for `selector`, for `all` and `all/N`
/// the first that Device::open_all would open. The device isn't opened if an earlier process kept
/// what is to be known of it in the cache. Throws as Device::open and the other `plan` do.
Plan plan(const Scene& scene, std::string_view selector, const PlanOptions& options = {});

/// "1.5 GB": three digits at most.
std::string bytes_text(double bytes);

}  // namespace voxelume::v1
