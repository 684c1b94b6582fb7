// SPDX-License-Identifier: Apache-2.0
// scene -> the memory that each step of rendering it takes of a device, by a walk through the steps
// on a counting device.
#pragma once

#include <string>
#include <vector>

#include "runtime/analysis/image_programs.hpp"
#include "runtime/memory/counted_grids.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/stages/trace/ray_arrays.hpp"

namespace voxelume {

/// The maximum bytes of the device during each step, with what stays from the steps before.
struct FrameMemory {
    std::vector<CountedGrid> grids;  ///< counted and freed again
    WorldCounts world;
    double voxelize = 0, place = 0, index = 0, image = 0;
    double volume = 0;             ///< for the display's volumetric image instead of the image
    double volume_voxels = 0;      ///< listed in the volumetric image
    double pyramid = 0;            ///< part of `image` and `volume`
    double dilated_occupancy = 0;  ///< part of `image`
    double light_host_bytes = 0;   ///< main memory for emitters, the sky and many lights
    ForeseenImage foreseen;        ///< made with the expected estimate
    RayBytes rays;                 ///< the maximum that rays may need
    std::string largest_buffer;    ///< the largest buffer of placing and indexing
    double largest_bytes = 0;

    double built() const;  ///< the maximum while the world is built
};

/// A counting device with the batches of another device.
Device counting_like(const DeviceInfo& device);

/// Follows WorldBuilder and Renderer through a single frame on a device. With the minimum estimate
/// only the first reflections and refractions are counted, whose arrays are made in any case.
///
/// Throws as list_instances and placed_objects do, and Error::limit for an exact mesh in a world
/// that is too large for it.
FrameMemory walk_frame(const Scene& scene, AssetStore& meshes, ObjectCounts& objects,
                       const DensityPlan& medium, Estimate estimate, const DeviceInfo& device);

}  // namespace voxelume
