// object grids on a counting device -> the world's voxels and pyramid there, made as forming a
// world makes them.
#pragma once

#include <span>

#include "runtime/analysis/placed_objects.hpp"
#include "runtime/stages/instance/instance_model.hpp"
#include "runtime/stages/place/place.hpp"

namespace voxelume {

/// What placing objects, or indexing a grid, is expected to find.
struct WorldCounts {
    size_t bricks = 0;      ///< stored
    size_t voxels = 0;      ///< that rays must see
    size_t primitives = 0;  ///< listed by them
};

/// As Placer::place for the first time: the voxels of a world. What only its painters need goes.
BrickGrid count_placing(const Device& device, std::span<const PlacedObject> objects,
                        const GridFrame& frame, const WorldCounts& counts);

/// A pyramid, and the marks that it was made from.
struct CountedPyramid {
    Pyramid pyramid;
    Buffer<uint64_t> masks;
};

/// As Indexer::index.
CountedPyramid count_index(const Device& device, const BrickGrid& grid, const WorldCounts& counts);

/// As InstanceModels::join; `models` are the counts of the listed grids.
Pyramid count_joining(const Device& device, const ListedInstances& listed, const Pyramid& world,
                      std::span<const WorldCounts> models);

}  // namespace voxelume
