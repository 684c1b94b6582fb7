// SPDX-License-Identifier: Apache-2.0
// Voxels with colours, one after the other -> the bricks of a model.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/base/files/input_file.hpp"
#include "runtime/geometry/voxel_model.hpp"

namespace voxelume {

/// A box of cells in which voxels are set. Memory is allocated for bricks with voxels only.
class CellBricks {
  public:
    /// The cells from `low` to one before `high`, in the model's coordinates: a voxel is 1 long,
    /// Y is up. Throws Error::input where a model may not have as many.
    CellBricks(const glm::ivec3& low, const glm::ivec3& high, const InputFile& file);

    /// Calls a function that sets its voxels twice: the first time bricks are counted and checked
    /// against the limit, then memory is allocated for all of them at once.
    template <class SetAll>
    void fill(const SetAll& set_all) {
        is_counting_ = true;
        set_all();
        is_counting_ = false;
        add_cells(count_);
        set_all();
    }

    /// Makes the cell, which must lie in the box, a voxel with the colour 0xTTBBGGRR. The
    /// transparency in the highest byte is 0 for opaque voxels, and at most 254.
    void set(const glm::ivec3& cell, uint32_t color) {
        const glm::ivec3 at = cell - first_, b = at / kBrickSize, in = at % kBrickSize;
        uint32_t& number =
            numbers_[size_t(b.x) + size_t(bricks_.x) * size_t(b.y + bricks_.y * b.z)];
        if (number == kNone) number = add_brick();
        if (is_counting_) return;
        cells_[size_t(number) * kVoxelsPerBrick + size_t(in.x | in.y << 4 | in.z << 8)] = color;
    }

    /// The voxels as cubes. Colours are left out where all are white. Throws Error::input where
    /// there is no voxel.
    VoxelModel model() const;

  private:
    static constexpr uint32_t kNone = 0xFFFFFFFF;
    uint32_t add_brick();
    void add_cells(size_t bricks);
    void fill_occupancy(const uint32_t* cells, uint64_t* leaves) const;

    const InputFile& file_;
    GridFrame frame_;
    glm::ivec3 first_{0}, bricks_{0};
    std::vector<uint32_t> numbers_;  ///< by brick: index into cells_
    std::vector<uint32_t> cells_;    ///< colours; 0xFFFFFFFF is no voxel
    uint32_t count_ = 0;
    bool is_counting_ = false;
};

}  // namespace voxelume
