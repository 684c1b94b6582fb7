// SPDX-License-Identifier: Apache-2.0
// scene -> the memory of a device at each step of rendering it, by a walk through the steps on a
// counting device.
#pragma once

#include <string>
#include <vector>

#include "runtime/memory/counted_grids.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/stages/trace/ray_arrays.hpp"

namespace voxelume {

/// Bytes of the device at the height of each step, what stays from the steps before included.
struct FrameMemory {
    std::vector<CountedGrid> grids;  ///< given up
    WorldCounts world;
    double voxelize = 0, place = 0, index = 0, image = 0;
    double volume = 0;             ///< instead of the image: of the volumetric one of its display
    double pyramid = 0;            ///< part of the last two
    double dilated_occupancy = 0;  ///< part of the last
    RayBytes rays;                 ///< all that they may need
    std::string largest_buffer;    ///< of placing and indexing
    double largest_bytes = 0;

    double built() const;  ///< at the height of forming the world
};

/// Follows WorldBuilder and Renderer through a single frame. With the least estimate only the first
/// reflections and refractions are counted, whose arrays are made whatever is met.
///
/// Throws as list_instances and placed_objects do, and Error::limit for an exact mesh in a world
/// that is too large for it.
FrameMemory walk_frame(const Scene& scene, AssetStore& meshes, ObjectCounts& objects,
                       const DensityPlan& medium, Estimate estimate);

}  // namespace voxelume
