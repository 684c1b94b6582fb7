// What rendering took: counts, times and memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "values.hpp"

namespace voxelume::v1 {

/// What a frame's world is to the one before on its device.
enum class WorldReuse { kept, instances_moved, built };

/// What a frame's image is to the one before on its device.
enum class ImageReuse {
    kept,    ///< the frame is still
    shaded,  ///< new light on the same surfaces
    traced
};

struct StageSeconds {
    double load = 0;  ///< reading files of models
    double voxelize = 0;
    double place = 0;
    double index = 0;
    double cache = 0;  ///< writing models and worlds to the disk
    double image = 0;
};

/// Rays and paths.
struct RayCounts {
    uint64_t sight_rays = 0;
    uint64_t beams = 0;                ///< sent along 16 sight rays each
    uint64_t clear_beams = 0;          ///< of these, those that see nothing
    uint64_t display_lines = 0;        ///< probe lines along a display's lattice
    uint64_t clear_display_lines = 0;  ///< not sent, as they pass all objects by
    uint64_t shadow_rays = 0;
    uint64_t light_beams = 0;
    uint64_t secondary_rays = 0;    ///< reflected, refracted, and gone on through surfaces
    uint64_t ended_paths = 0;       ///< not followed for their small weight
    uint64_t medium_overflows = 0;  ///< rays in more overlapping objects than they can remember
    uint32_t not_finite = 0;        ///< values that became 0
};

/// Instances, and the models that they share.
struct InstanceCounts {
    uint32_t instances = 0;
    uint32_t models = 0;
    uint64_t voxels = 0;  ///< of the models, each counted once
    uint64_t bytes = 0;
    double seconds = 0;
};

/// What one frame made anew.
struct FrameStatistics {
    int frame = 1;
    size_t device = 0;  ///< its place in Statistics::devices
    WorldReuse world = WorldReuse::built;
    ImageReuse image = ImageReuse::traced;
    uint64_t meshes_read = 0;
    uint64_t voxelized = 0;
    uint64_t models_from_cache = 0;
    uint64_t painted_bricks = 0;
    bool world_from_cache = false;
    uint32_t instances_moved = 0;
    uint32_t instance_models_indexed = 0;
    bool keeps_nothing = false;  ///< for want of memory, for the next frame of its device
    StageSeconds seconds{};
};

/// A device that took part.
struct DeviceStatistics {
    std::string name{};
    std::string driver{};
    int compute_units = 0;
    int lanes = 1;
};

/// What a run took: the sums over its frames and devices, or the largest of a frame for sizes.
struct Statistics {
    std::vector<DeviceStatistics> devices{};
    Size size{};       ///< pixels
    size_t files = 0;  ///< written
    uint64_t voxels = 0;
    uint64_t triangles = 0;
    uint64_t culled_objects = 0;  ///< that no ray can meet: not voxelized
    uint64_t world_bytes = 0;
    RayCounts rays{};
    InstanceCounts instances{};
    StageSeconds seconds{};
    double open_seconds = 0;   ///< before the first frame
    double write_seconds = 0;  ///< writing files, perhaps while other work went on
    double total_seconds = 0;
    std::optional<int>
        one_by_one_from;  ///< frame from which on none overlapped, for want of memory
    std::vector<FrameStatistics> frames{};

    // Counters of the devices since they were opened.
    uint64_t peak_device_bytes = 0;
    std::map<std::string, uint64_t> launches{};  ///< by kernel
    std::map<std::string, double> kernel_ms{};   ///< by kernel, with RenderOptions::time_kernels
    std::map<std::string, uint64_t> allocated_bytes{};  ///< by buffer
    uint64_t programs_made = 0;
    uint64_t programs_from_cache = 0;  ///< of these, not compiled again
    double programs_ms = 0;
};

/// The statistics as JSON, as `voxelume render --stats-json` writes them.
std::string to_json(const Statistics& statistics);

}  // namespace voxelume::v1
