// SPDX-License-Identifier: Apache-2.0
// Floods through grids of voxels, 64 voxels of a row at once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "runtime/verify/exact/occupancy.hpp"

namespace voxelume {

/// The voxels of a grid, in rows along x of whole 64-bit words. Bits beyond the grid are 0.
class VoxelRows {
  public:
    explicit VoxelRows(const glm::ivec3& size)
        : size_(size),
          words_(size_t(size.x + 63) / 64),
          bits_(words_ * size_t(size.y) * size_t(size.z), 0) {}

    explicit VoxelRows(const BrickGrid& grid) : VoxelRows(grid.frame.size) {
        const ReadOccupancy read(grid);
        const glm::ivec3 bricks = grid.frame.bricks();
        for (glm::ivec3 b{0}; b.z < bricks.z; ++b.z)
            for (b.y = 0; b.y < bricks.y; ++b.y)
                for (b.x = 0; b.x < bricks.x; ++b.x) add(b, read.masks(b));
    }

    const glm::ivec3& size() const { return size_; }
    size_t words() const { return words_; }
    uint64_t* row(int y, int z) { return &bits_[words_ * size_t(y + size_.y * z)]; }
    const uint64_t* row(int y, int z) const { return &bits_[words_ * size_t(y + size_.y * z)]; }

    /// The number of voxels that are in both sets.
    size_t common(const VoxelRows& other) const {
        size_t count = 0;
        for (size_t i = 0; i < bits_.size(); ++i)
            count += size_t(__builtin_popcountll(bits_[i] & other.bits_[i]));
        return count;
    }

  private:
    void add(const glm::ivec3& brick, const std::array<uint64_t, 64>& masks) {
        for (int z = 0; z < std::min(16, size_.z - 16 * brick.z); ++z)
            for (int y = 0; y < std::min(16, size_.y - 16 * brick.y); ++y) {
                uint64_t voxels = 0;
                for (int leaf = 0; leaf < 4; ++leaf) {
                    const uint64_t mask = masks[size_t(leaf + 4 * (y / 4) + 16 * (z / 4))];
                    voxels |= (mask >> (4 * (y % 4) + 16 * (z % 4)) & 15) << 4 * leaf;
                }
                const int left = size_.x - 16 * brick.x;
                if (left < 16) voxels &= (uint64_t{1} << left) - 1;
                row(16 * brick.y + y, 16 * brick.z + z)[brick.x / 4] |= voxels << brick.x % 4 * 16;
            }
    }

    glm::ivec3 size_;
    size_t words_;
    std::vector<uint64_t> bits_;
};

/// A flood from voxel (0, 0, 0) through all voxels except the walls: from voxel to voxel through
/// faces, or through edges and corners as well.
class RowFlood {
  public:
    RowFlood(const VoxelRows& wall, bool through_corners)
        : wall_(wall), through_corners_(through_corners), reached_(wall.size()) {
        const glm::ivec3 size = wall.size();
        is_waiting_.resize(size_t(size.y) * size_t(size.z), false);
        reached_.row(0, 0)[0] = 1;
        wait(0, 0);
        while (!waiting_.empty()) {
            const int number = waiting_.back();
            waiting_.pop_back();
            is_waiting_[size_t(number)] = false;
            leave_row(number % size.y, number / size.y);
        }
    }
    const VoxelRows& reached() const { return reached_; }

  private:
    void wait(int y, int z) {
        const int number = y + wall_.size().y * z;
        if (is_waiting_[size_t(number)]) return;
        is_waiting_[size_t(number)] = true;
        waiting_.push_back(number);
    }

    uint64_t open(int y, int z, size_t word) const {
        const int left = wall_.size().x - 64 * int(word);
        const uint64_t grid = left < 64 ? (uint64_t{1} << left) - 1 : ~uint64_t{0};
        return grid & ~wall_.row(y, z)[word];
    }

    /// Spreads along a row, then into the neighbouring rows.
    void leave_row(int y, int z) {
        uint64_t* row = reached_.row(y, z);
        for (bool grows = true; grows;) {
            grows = false;
            for (size_t i = 0; i < wall_.words(); ++i) {
                const uint64_t spread = (row[i] | neighbours(row, i)) & open(y, z, i);
                grows |= spread != row[i];
                row[i] = spread;
            }
        }
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
                if (dy || dz) enter_row(row, dy != 0 && dz != 0, y + dy, z + dz);
    }

    void enter_row(const uint64_t* from, bool is_across_edge, int y, int z) {
        if (is_across_edge && !through_corners_) return;
        if (std::min(y, z) < 0 || y >= wall_.size().y || z >= wall_.size().z) return;
        uint64_t* row = reached_.row(y, z);
        for (size_t i = 0; i < wall_.words(); ++i) {
            const uint64_t near = from[i] | (through_corners_ ? neighbours(from, i) : 0);
            const uint64_t entered = near & open(y, z, i) & ~row[i];
            if (!entered) continue;
            row[i] |= entered;
            wait(y, z);
        }
    }

    /// The voxels of a word that neighbour one of the row's voxels along x.
    uint64_t neighbours(const uint64_t* row, size_t word) const {
        uint64_t near = row[word] << 1 | row[word] >> 1;
        if (word > 0) near |= row[word - 1] >> 63;
        if (word + 1 < wall_.words()) near |= row[word + 1] << 63;
        return near;
    }

    const VoxelRows& wall_;
    bool through_corners_;
    VoxelRows reached_;
    std::vector<int> waiting_;
    std::vector<bool> is_waiting_;
};

}  // namespace voxelume
