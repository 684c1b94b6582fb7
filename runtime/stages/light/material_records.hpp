// SPDX-License-Identifier: Apache-2.0
// materials -> the records and tables that kernels read.
#pragma once

#include <vector>

#include "kernels/shared/scene.h"
#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// The record of a material of Whitted's model.
MaterialRecord material_record(const Material& material, const GridFrame& world);

/// The records of all materials, followed by the tables of physically based ones. Without
/// Features::physical these are records of Whitted's model.
std::vector<MaterialRecord> material_records(const Scene& scene, const GridFrame& world,
                                             const Features& features);

}  // namespace voxelume
