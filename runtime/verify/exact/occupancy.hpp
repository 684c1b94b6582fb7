// SPDX-License-Identifier: Apache-2.0
// The bits of a brick grid's voxels on the host.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "runtime/grid/grid.hpp"

namespace voxelume {

/// The position of a voxel's bit in the 64 masks of its brick.
struct VoxelSlot {
    explicit VoxelSlot(const glm::ivec3& v)
        : leaf(uint32_t(v.x % 16 / 4 + 4 * (v.y % 16 / 4) + 16 * (v.z % 16 / 4))),
          bit(uint64_t{1} << (v.x % 4 + 4 * (v.y % 4) + 16 * (v.z % 4))) {}

    uint32_t leaf;
    uint64_t bit;
};

/// The index of brick b among `bricks`.
inline size_t brick_number(const glm::ivec3& b, const glm::ivec3& bricks) {
    return size_t(b.x) + size_t(bricks.x) * (size_t(b.y) + size_t(bricks.y) * size_t(b.z));
}

/// A grid's occupancy, read back from the device.
class ReadOccupancy {
  public:
    explicit ReadOccupancy(const BrickGrid& grid)
        : bricks_(grid.frame.bricks()), slots_(grid.slots.read()), masks_(grid.occupancy.read()) {}

    bool is_set(const glm::ivec3& v) const {
        const uint32_t slot = slots_[brick_number(v / 16, bricks_)];
        if (slot >= kBrickInside) return slot == kBrickInside;
        const VoxelSlot voxel_slot(v);
        return (masks_[size_t{64} * slot + voxel_slot.leaf] & voxel_slot.bit) != 0;
    }
    std::array<uint64_t, 64> masks(const glm::ivec3& brick) const {
        std::array<uint64_t, 64> masks{};
        const uint32_t slot = slots_[brick_number(brick, bricks_)];
        if (slot < kBrickInside)
            std::copy_n(&masks_[size_t{64} * slot], masks.size(), masks.begin());
        if (slot == kBrickInside) masks.fill(~uint64_t{0});
        return masks;
    }

  private:
    glm::ivec3 bricks_;
    std::vector<uint32_t> slots_;
    std::vector<uint64_t> masks_;
};

}  // namespace voxelume
