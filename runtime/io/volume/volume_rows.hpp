// SPDX-License-Identifier: Apache-2.0
// A sparse volume, row by row along its first axis, as dense formats need it.
#pragma once

#include <cstdint>
#include <utility>

#include "runtime/image/volume.hpp"

namespace voxelume {

/// Walks once through all size.y * size.z rows in ascending order of `indices`.
class VolumeRows {
  public:
    explicit VolumeRows(const Volume& volume)
        : volume_(volume), width_(uint64_t(volume.frame.size.x)) {}

    /// The begin and end of the next row's listed voxels in the volume's arrays.
    std::pair<size_t, size_t> next() {
        const size_t first = position_;
        row_start_ = row_end_;
        row_end_ += width_;
        while (position_ < volume_.indices.size() && volume_.indices[position_] < row_end_)
            ++position_;
        return {first, position_};
    }

    /// The column of the voxel at that position, for positions of the row that next() returned
    /// last.
    size_t column(size_t position) const { return volume_.indices[position] - row_start_; }

  private:
    const Volume& volume_;
    uint64_t width_, row_start_ = 0, row_end_ = 0;
    size_t position_ = 0;
};

}  // namespace voxelume
