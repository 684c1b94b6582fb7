// SPDX-License-Identifier: Apache-2.0
// The voxels of solids' parts in which the surface of a part is the surface of the solid.
#pragma once

#include <vector>

#include "runtime/grid/placed_world.hpp"
#include "runtime/opencl/program.hpp"

namespace voxelume {

/// True if some object has several fields.
bool has_parts(const PlacedWorld& world);

/// The maximum depth of nested brackets in the objects' formulas.
uint32_t chain_depth(const PlacedWorld& world);

/// Removes voxels in which other parts decide what is inside from `masks`, which hold the voxels
/// that the surfaces of all fields may cross. The bricks of field i begin at number first_of[i];
/// `program` is index_fields.cl.
void join_parts(const Device& device, const Program& program, const PlacedWorld& world,
                const std::vector<uint32_t>& first_of, const Buffer<uint64_t>& masks);

}  // namespace voxelume
