// SPDX-License-Identifier: Apache-2.0
// The work of rendering: counts, times and memory.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "values.hpp"
#include "warning.hpp"

namespace voxelume::v1 {

/// The relation of a frame's world to the one before on its device.
enum class WorldReuse { kept, instances_moved, built };

/// The relation of a frame's image to the one before on its device.
enum class ImageReuse {
    kept,    ///< the image didn't change
    shaded,  ///< new light on the same surfaces
    traced
};

/// The word in JSON: "kept", "instances moved" or, for `built`, "formed", which older versions
/// wrote and scripts compare.
const char* name_of(WorldReuse world);

/// The word in summaries and in JSON: "kept", "shaded" or "traced".
const char* name_of(ImageReuse image);

/// Seconds that each stage took.
struct StageSeconds {
    double load = 0;      ///< reading files of models
    double voxelize = 0;  ///< meshes and solids to voxels
    double place = 0;     ///< objects into the world's voxels
    double index = 0;     ///< the world's pyramid, and instances
    double cache = 0;     ///< writing models and worlds to the disk
    double image = 0;     ///< sight rays to pixels, or to display voxels
};

/// Rays and paths.
struct RayCounts {
    uint64_t sight_rays = 0;           ///< rays from the observer
    uint64_t beams = 0;                ///< beams sent along 16 sight rays each
    uint64_t clear_beams = 0;          ///< beams among these that see nothing
    uint64_t display_lines = 0;        ///< probe lines along a display's lattice
    uint64_t clear_display_lines = 0;  ///< lines not sent, as they miss all objects
    uint64_t contrasting_pixels = 0;   ///< pixels of adaptive images that have all samples
    uint64_t shadow_rays = 0;          ///< rays to lights
    uint64_t light_beams = 0;          ///< beams from lights, where shadow rays end
    uint64_t secondary_rays = 0;       ///< rays reflected, refracted or continued through surfaces
    uint64_t ended_paths = 0;          ///< paths not followed for their small weight
    uint64_t medium_overflows = 0;     ///< rays in more overlapping objects than they can remember
    uint32_t not_finite = 0;           ///< values that became 0
    /// The standard error of light in 4 x 4 pixels over their mean, as a root mean square over all
    /// images. Empty where none has a target of noise or time.
    std::optional<double> noise{};
    /// The standard error of light in groups of 16 voxels over their mean, as a root mean square
    /// over all volumetric images. Empty where none has a target of noise or time.
    std::optional<double> volume_noise{};
};

/// Instances, and the models that they share.
struct InstanceCounts {
    uint32_t instances = 0;  ///< instances in the world
    uint32_t models = 0;     ///< models that they share
    uint64_t voxels = 0;     ///< voxels of the models, each counted once
    uint64_t bytes = 0;      ///< bytes of these models
    double seconds = 0;      ///< making them ready
};

/// The work of one frame.
struct FrameStatistics {
    int frame = 1;                          ///< its number
    size_t device = 0;                      ///< its index in Statistics::devices
    WorldReuse world = WorldReuse::built;   ///< change of the world
    ImageReuse image = ImageReuse::traced;  ///< work for the image
    uint64_t meshes_read = 0;               ///< files of models
    uint64_t voxelized = 0;                 ///< models, and exact objects
    uint64_t models_from_cache = 0;         ///< models whose voxels were on the disk
    uint64_t painted_bricks = 0;            ///< bricks that objects were placed into
    bool world_from_cache = false;          ///< the world of an earlier run was read
    uint32_t instances_moved = 0;           ///< instances that are new or stand elsewhere
    uint32_t instance_models_indexed = 0;   ///< models made ready for rays
    /// True: nothing is kept for the device's next frame, for lack of memory.
    bool keeps_nothing = false;
    StageSeconds seconds{};  ///< includes waiting, where frames overlap
    uint32_t moments = 1;    ///< moments that the image's samples show, while a shutter is open
};

/// A device that took part.
struct DeviceStatistics {
    std::string name{};     ///< name that its driver gives
    std::string driver{};   ///< version of its driver
    int compute_units = 0;  ///< compute units, as OpenCL counts them
    int lanes = 1;          ///< rays that one work-item handles
};

/// The work of a run: sums over its frames and devices; for sizes, the maximum over its frames.
struct Statistics {
    std::vector<DeviceStatistics> devices{};          ///< devices that rendered
    Size size{};                                      ///< pixels of an image, or of a view
    bool images = true;                               ///< false: volumetric images alone
    int bands = 1;                                    ///< bands of each image; 1: it was whole
    std::optional<std::array<int, 3>> volume_size{};  ///< voxels of a volumetric image, if any
    size_t files = 0;                                 ///< files written
    uint64_t voxels = 0;          ///< voxels with a surface, in the frame with most
    uint64_t triangles = 0;       ///< triangles of the models, in the frame with most
    uint64_t culled_objects = 0;  ///< objects that no ray can meet: not voxelized
    uint64_t world_bytes = 0;     ///< bytes on the device, in the frame with most
    RayCounts rays{};             ///< counts of all frames
    InstanceCounts instances{};   ///< counts of the frame with most
    StageSeconds seconds{};       ///< seconds of all frames, by stage
    double open_seconds = 0;      ///< seconds before the first frame
    double write_seconds = 0;     ///< seconds of writing files, perhaps while other work went on
    double total_seconds = 0;     ///< seconds by the clock
    /// Frame from which on none overlapped, for lack of memory.
    std::optional<int> one_by_one_from;
    std::vector<FrameStatistics> frames{};  ///< one for each frame, or for each view of a quilt
    std::vector<Warning> warnings{};        ///< probable mistakes, each once

    // Counters of the devices since they were opened.
    uint64_t peak_device_bytes = 0;              ///< bytes in buffers at once, all devices together
    std::map<std::string, uint64_t> launches{};  ///< launches of each kernel
    /// Milliseconds of each kernel, with RenderOptions::time_kernels.
    std::map<std::string, double> kernel_ms{};
    std::map<std::string, uint64_t> allocated_bytes{};  ///< bytes of each buffer
    uint64_t programs_made = 0;                         ///< OpenCL programs made ready
    uint64_t programs_from_cache = 0;  ///< programs among these, not compiled again
    double programs_ms = 0;            ///< milliseconds to make them ready, perhaps beside others
};

/// Adds those of a later run on the same devices: counts and seconds are summed, sizes are the
/// larger ones, and the counters of devices the later ones.
void add_statistics(const Statistics& later, Statistics& sum);

/// The statistics as JSON, as `voxelume render --stats-json` writes them.
std::string to_json(const Statistics& statistics);

}  // namespace voxelume::v1
