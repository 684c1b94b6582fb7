// scene -> image: the paper's algorithm, stage by stage.
#pragma once

#include <functional>

#include "runtime/image.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene.hpp"
#include "runtime/world.hpp"

namespace voxelume {

/// What a frame took, for the summary line, --stats-json and the tests.
struct RenderReport {
    WorldReport world;
    double image_seconds = 0;  ///< sight, trace, shade and resolve, with building their kernels
    uint64_t voxels = 0;       ///< surface voxels in the world's pyramid
    uint64_t world_bytes = 0;  ///< of the pyramid on the device
    uint64_t sight_rays = 0;
    uint64_t shadow_rays = 0;
    uint64_t secondary_rays = 0;  ///< reflected, refracted, and gone on through surfaces
    uint64_t ended_paths = 0;     ///< not followed for their small weight
    uint64_t lost_members = 0;    ///< rays that came into more overlapping objects than they can
                                  ///< remember: the image is wrong there
    uint32_t not_finite = 0;      ///< values that became 0; more than 0 is a fault of ours
};

/// Renders the flat image of a scene's observer on a device.
///
/// `progress` is called with the tiles done and their number. Throws Error::limit before memory is
/// taken when the scene's plan doesn't fit the device, and Error as its stages do.
Image render(const Device& device, const Scene& scene, RenderReport& report,
             const std::function<void(uint32_t done, uint32_t total)>& progress = {});

}  // namespace voxelume
