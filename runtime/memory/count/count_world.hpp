// SPDX-License-Identifier: Apache-2.0
// object grids on a counting device -> the world's voxels and pyramid there, made as WorldBuilder
// makes them.
#pragma once

#include <span>

#include "runtime/analysis/placed_objects.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/instance/instance_model.hpp"
#include "runtime/stages/place/place.hpp"

namespace voxelume {

/// The expected counts of placing objects, or of indexing a grid.
struct WorldCounts {
    size_t bricks = 0;        ///< stored bricks
    size_t voxels = 0;        ///< voxels that rays must see
    size_t primitives = 0;    ///< primitives that these voxels list
    size_t field_bricks = 0;  ///< bricks of smooth objects' grids, if these are stored separately
    size_t other_bricks = 0;  ///< bricks of the grid of all other objects
};

/// The numbers of bricks of smooth objects' grids that are stored separately, and of the grid that
/// all other objects share.
struct PartBricks {
    double of_fields = 0, of_others = 0;
};

/// The voxels of a world, and the buffers with which its objects are painted.
struct CountedWorld {
    BrickGrid grid;  ///< voxels of all objects but those of `fields`
    std::vector<Buffer<uint64_t>> painters;
    BrickGrid fields;    ///< the separate grids of smooth objects, as one
    PyramidParts parts;  ///< parts of the pyramid, if there are `fields`
};

/// Follows the first call of Placer::place.
CountedWorld count_placing(const Device& device, std::span<const PlacedObject> objects,
                           const GridFrame& frame, const WorldCounts& counts);

/// Follows WorldBricks where a world gets more bricks than it has room for: each array is copied to
/// a larger one, with room for a quarter more.
void count_growth(const Device& device, BrickGrid& world);

/// Follows WorldPlacer::place where `bricks` of a world change. Returns the triangles and
/// solids that the world then has; all other buffers are freed again.
BrickGrid count_repainting(const Device& device, std::span<const PlacedObject> objects,
                           const CountedWorld& world, const PartBricks& bricks);

/// A pyramid, and the marks that it was made from.
struct CountedPyramid {
    Pyramid pyramid;
    Buffer<uint64_t> masks;
};

/// Follows Indexer::index.
CountedPyramid count_index(const Device& device, const BrickGrid& grid, const WorldCounts& counts);

CountedPyramid count_index(const Device& device, const CountedWorld& world,
                           const WorldCounts& counts);

/// Follows Indexer::index where it has indexed the world before: `masks` of the grid are copied to
/// larger ones, for a quarter more bricks.
Pyramid count_reindexing(const Device& device, const CountedWorld& world, const WorldCounts& counts,
                         Buffer<uint64_t>& masks);

/// Follows InstanceModels::join; `counts` are those of the listed grids, whose pyramids are added
/// to `kept`.
Pyramid count_joining(const Device& device, const ListedInstances& listed, const Pyramid& world,
                      std::span<const WorldCounts> counts, std::vector<ModelPyramid>& kept);

}  // namespace voxelume
