// layers of surfaces along sight rays -> P in the layout `rays`, where some surfaces let light
// through.
#pragma once

#include <vector>

#include "kernels/shared/display.h"
#include "runtime/image/volume.hpp"
#include "runtime/stages/display/display_rays.hpp"

namespace voxelume {

/// What depths and light mean in the records.
struct LayerEnvironment {
    DisplaySteps steps;  ///< absorption 0: space isn't shown
    Environment environment;
    float near_depth;  ///< metres
};

/// Fills the volume, whose frame is set, from the records of all layers: those of a batch one after
/// another, the nearest first.
///
/// Every surface gets a voxel with its opacity, and so does the medium before it; those that share
/// a voxel are laid over one another. Laid over one another themselves, a ray's voxels are its
/// light. What an object that a ray goes through takes of single channels is taken from the colours
/// of the voxels behind.
void assemble_layers(const std::vector<LayerRecords>& layers, const LayerEnvironment& environment,
                     Volume& volume);

}  // namespace voxelume
