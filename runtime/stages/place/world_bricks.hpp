// The bricks that a world stores: which, in what slots, and the buffers that hold them.
#pragma once

#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"

namespace voxelume {

struct WorldParts;

/// Keeps a grid's slots without gaps while bricks come and go. The grid must outlive it.
class WorldBricks {
  public:
    /// No brick is stored yet; `world` has its frame.
    WorldBricks(const Device& device, const WorldParts& parts, BrickGrid& world);

    /// Has the buffers that a world of these parts needs, and no others. A new one holds what such
    /// a world has where none of the objects are that need it: `attribute` in every voxel, if
    /// words.
    void store_like(const WorldParts& parts);

    /// Stores the bricks of `brick_numbers` whose state is VXL_SURFACE, marks those that are
    /// VXL_FULL as inside and drops the others; `states` has those of all bricks of the world. The
    /// contents of bricks that aren't named stay. Returns those of `brick_numbers` that are stored.
    std::vector<uint32_t> store(const std::vector<uint32_t>& brick_numbers,
                                const std::vector<uint8_t>& states);

    /// Empties bricks that are stored.
    void clear(const std::vector<uint32_t>& brick_numbers);

    uint32_t slot(uint32_t place) const { return slots_[place]; }

  private:
    void fill_gaps(const std::vector<uint32_t>& gaps);
    void reserve(uint32_t bricks);

    Device device_;
    bool smooth_, occupancy_, has_attributes_, colors_;
    BrickGrid& world_;
    Program program_;
    std::vector<uint32_t> slots_;        ///< BrickGrid::slots
    std::vector<uint32_t> coordinates_;  ///< BrickGrid::coordinates
    uint32_t reserved_ = 0;              ///< bricks that the buffers have room for
};

}  // namespace voxelume
