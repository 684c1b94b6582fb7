// SPDX-License-Identifier: Apache-2.0
// layers of surfaces along sight rays -> P in the layout `rays`, if some surfaces let light
// through.
#pragma once

#include <vector>

#include "kernels/shared/display.h"
#include "runtime/image/volume.hpp"
#include "runtime/stages/display/display_rays.hpp"

namespace voxelume {

/// The meaning of depths and light in the records.
struct LayerEnvironment {
    DisplaySteps steps;  ///< absorption 0: the environment isn't shown
    Environment environment;
    float near_depth;  ///< metres
};

/// Fills the volume, whose frame is set, from the records of all layers. The layers of a batch
/// follow one another, the nearest first.
///
/// Every surface gets a voxel with its opacity, and so does the medium in front of it; surfaces
/// that share a voxel are composited. Compositing a ray's voxels gives its light. If an object
/// along the ray absorbs single channels, their light is subtracted from the colours of the voxels
/// behind.
void assemble_layers(const std::vector<LayerRecords>& layers, const LayerEnvironment& environment,
                     Volume& volume);

}  // namespace voxelume
