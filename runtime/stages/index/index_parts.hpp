// SPDX-License-Identifier: Apache-2.0
// The voxels of solids' parts: those in which the surface of a part is the solid's.
#pragma once

#include <vector>

#include "runtime/grid/placed_world.hpp"
#include "runtime/opencl/program.hpp"

namespace voxelume {

/// True if some object has several fields.
bool has_parts(const PlacedWorld& world);

/// Brackets of the objects' formulas that are within each other.
uint32_t chain_depth(const PlacedWorld& world);

/// Takes from `masks`, which hold the voxels that the surfaces of all fields may cross, those in
/// which other parts decide what is inside. The bricks of field i begin at number first_of[i];
/// `program` is index_fields.cl.
void join_parts(const Device& device, const Program& program, const PlacedWorld& world,
                const std::vector<uint32_t>& first_of, const Buffer<uint64_t>& masks);

}  // namespace voxelume
