// SPDX-License-Identifier: Apache-2.0
// The bricks that a world stores: their slots, and their buffers.
#pragma once

#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"

namespace voxelume {

struct WorldParts;

/// The constants of place_bricks.cl for a world of these parts.
Defines brick_defines(const WorldParts& parts);

/// Keeps a grid's slots without gaps while bricks come and go. The grid must outlive it.
class WorldBricks {
  public:
    /// Begins without any stored brick; `world` has its frame.
    WorldBricks(const Device& device, const WorldParts& parts, BrickGrid& world);

    /// Gives the world exactly the buffers that a world of these parts needs. A new buffer holds
    /// the values of a world without the objects that need it; a new buffer of attributes holds
    /// `attribute` in every voxel.
    void store_like(const WorldParts& parts);

    /// Stores the bricks of `brick_numbers` whose state is VXL_SURFACE, marks those that are
    /// VXL_FULL as inside and drops the others; `states` has the states of all bricks of the world.
    /// The contents of bricks that aren't named stay. Returns the stored bricks among
    /// `brick_numbers`.
    std::vector<uint32_t> store(const std::vector<uint32_t>& brick_numbers,
                                const std::vector<uint8_t>& states);

    /// Clears the contents of stored bricks; they stay stored.
    void clear(const std::vector<uint32_t>& brick_numbers);

    uint32_t slot(uint32_t brick_number) const { return slots_[brick_number]; }

  private:
    Kernel kernel(const char* name) const;
    void fill_gaps(const std::vector<uint32_t>& gaps);
    void reserve(uint32_t bricks);

    Device device_;
    bool smooth_, occupancy_, has_attributes_, colors_, normals_;
    Defines defines_;
    BrickGrid& world_;
    std::vector<uint32_t> slots_;        ///< BrickGrid::slots
    std::vector<uint32_t> coordinates_;  ///< BrickGrid::coordinates
    uint32_t reserved_ = 0;              ///< number of bricks that the buffers have room for
};

}  // namespace voxelume
