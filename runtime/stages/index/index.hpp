// SPDX-License-Identifier: Apache-2.0
// BrickGrid -> Pyramid: the voxels that rays must see, numbered and packed.
#pragma once

#include <memory>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/index/index_fields.hpp"

namespace voxelume {

/// Builds the pyramid that rays read from the bricks that `voxelize` or `place` made.
///
/// A voxel is in the pyramid if its occupancy bit is set (kind cubes or exact), or else if the
/// half-Taylor interpolant of its eight distances may have a zero in it (kind smooth; the bound is
/// proved in kernels/lib/surface/brick_field.h). Eight saturated distances are never a surface.
/// Voxels outside of frame.size are left out.
///
/// Bricks that are not stored have no voxels, not even kBrickInside ones. So the grid must store
/// every brick with a cell that isn't wholly outside or inside. It must also store every brick of a
/// solid set that has a voxel with an empty neighbour, also across the brick's side: rays enter a
/// solid through such a voxel.
///
/// The kind bits of the result: voxels of distance fields are smooth whatever their packed
/// attributes say. Occupied voxels have the kind of `attributes`; without attributes they are exact
/// if there are primitives, else cubes. Packed attributes are stored per voxel only if the grid has
/// attributes or both sorts of voxels; else all voxels have `attribute`.
///
/// The numbering depends on the grid alone, not on the device or its order of work. The pyramid
/// shares the grid's triangle and solid buffers. Throws Error::limit if the device's memory doesn't
/// suffice or for more than 2^30 voxels, 2^28 in grids with distances.
Pyramid build_index(const Device& device, const BrickGrid& grid);

/// The numbers of a pyramid's entries of each kind.
struct PyramidCounts {
    size_t sectors = 0;  ///< sectors with voxels
    size_t leaves = 0, voxels = 0, primitives = 0;
};

/// The kinds of data that a pyramid stores for its voxels.
struct PyramidParts {
    bool attributes = false, colors = false, normals = false, fields = false, exact = false;
    size_t listed_fields = 0;
};

/// The buffers of the pyramid of this grid, whose triangle and solid buffers it shares.
Pyramid allocate_pyramid(const Device& device, const BrickGrid& grid, const PyramidCounts& counts);
Pyramid allocate_pyramid(const Device& device, const BrickGrid& grid, const PyramidParts& parts,
                         const PyramidCounts& counts);

/// The arrays of a pyramid that kernels fill: VXL_WRITTEN_PARAMETERS of kernels.
struct WrittenVoxels {
    const Pyramid& pyramid;
};
void bind(KernelArguments& to, const WrittenVoxels& written);

/// Builds the pyramids of a grid's successive states, and looks for voxels only where the grid has
/// changed. The result equals that of `build_index`.
class Indexer {
  public:
    explicit Indexer(const Device& device);
    ~Indexer();
    Indexer(Indexer&&) noexcept;
    Indexer& operator=(Indexer&&) noexcept;

    /// `changed` holds the indices of the bricks that changed, appeared or disappeared since the
    /// last call; it is null if that is unknown. If it is empty, the result is the last call's
    /// pyramid.
    Pyramid index(const BrickGrid& grid, const std::vector<uint32_t>* changed);

    /// The pyramid of a placed world. `changed` is as in the function above; if the world has
    /// fields, it only matters whether it is empty.
    Pyramid index(const PlacedWorld& world, const std::vector<uint32_t>* changed);

  private:
    struct Kept;
    Device device_;
    FieldIndexer fields_;
    std::unique_ptr<Kept> kept_;
};

}  // namespace voxelume
