// SPDX-License-Identifier: Apache-2.0
// object grids -> S: joins the primitive lists of exact surfaces.
#pragma once

#include <span>

#include "runtime/stages/place/place.hpp"

namespace voxelume {

/// Makes room in the world for triangles' corners and the words of analytic solids.
void allocate_sources(const Device& device, size_t floats, size_t solid_words, BrickGrid& world);

/// Gives `world`, whose bricks are numbered, the primitives of all exact objects: per voxel in the
/// order of `objects`, with triangles and solids renumbered and their words those of the world.
/// Without exact objects it has none. Throws Error::limit for more than 2^32 list entries.
void join_exact_surfaces(const Device& device, std::span<const PlacedObject> objects,
                         BrickGrid& world);

}  // namespace voxelume
