// SPDX-License-Identifier: Apache-2.0
// The voxels of solids' parts: those in which the surface of a part is the solid's.
#pragma once

#include <vector>

#include "runtime/grid/placed_world.hpp"
#include "runtime/opencl/program.hpp"

namespace voxelume {

/// True if some object has several fields.
bool has_parts(const PlacedWorld& world);

/// Takes the voxels in which other parts decide from `masks`, which hold those that the surfaces of
/// all fields may cross. The bricks of field i begin at number first_of[i]; `program` is
/// index_fields.cl.
void join_parts(const Device& device, const Program& program, const PlacedWorld& world,
                const std::vector<uint32_t>& first_of, const Buffer<uint64_t>& masks);

}  // namespace voxelume
