// BrickGrid -> Pyramid: the voxels that rays must see, numbered and packed.
#pragma once

#include <memory>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"

namespace voxelume {

/// Builds the pyramid that rays read from the bricks that `voxelize` or `place` left.
///
/// A voxel is in the pyramid when its occupancy bit is set (kind cubes or exact), or else when the
/// half-Taylor interpolant of its eight distances may have a zero in it (kind smooth; the bound is
/// proved in kernels/lib/surface/brick_field.h). Eight saturated distances are never a surface.
/// Voxels outside of frame.size don't count.
///
/// Bricks that are not stored have no voxels, kBrickInside too. So the grid must store every brick
/// with a cell that isn't wholly outside or inside, and of a solid set every brick that has a voxel
/// with an empty neighbour, also across the brick's side: rays enter a solid through such a voxel.
///
/// Kind bits of the result: smooth for the second sort of voxel whatever its word says; for the
/// first as in `attributes`, without them exact if there are primitives, else cubes. One word per
/// voxel is stored only if the grid has attributes, or both sorts of voxel; else `attribute` is it.
///
/// The numbering depends on the grid alone, not on the device or its order of work. The pyramid
/// shares the grid's triangle and solid buffers. Throws Error::limit when the device's memory or
/// 2^30 voxels, 2^28 in grids with distances, don't suffice.
Pyramid build_index(const Device& device, const BrickGrid& grid);

/// What a pyramid holds.
struct PyramidCounts {
    size_t sectors = 0;  ///< with voxels
    size_t leaves = 0, voxels = 0, primitives = 0;
};

/// The buffers of the pyramid of such a grid, whose triangle and solid buffers it shares.
Pyramid allocate_pyramid(const Device& device, const BrickGrid& grid, const PyramidCounts& counts);

/// Builds the pyramids of one state of a grid after another, and looks for voxels only where the
/// grid has changed. The result is that of `build_index`.
class Indexer {
  public:
    explicit Indexer(const Device& device);
    ~Indexer();
    Indexer(Indexer&&) noexcept;
    Indexer& operator=(Indexer&&) noexcept;

    /// `changed` has the places of the bricks that changed, came or went since the last call; null
    /// where nothing is known. Where it is empty the pyramid is the last call's.
    Pyramid index(const BrickGrid& grid, const std::vector<uint32_t>* changed);

  private:
    struct Kept;
    Device device_;
    std::unique_ptr<Kept> kept_;
};

}  // namespace voxelume
