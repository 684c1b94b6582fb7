// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxel_art/cell_bricks.hpp"

#include <algorithm>

#include "kernels/shared/voxel.h"
#include "runtime/grid/brick_cells.hpp"
#include "runtime/io/voxels/voxel_limits.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kNoVoxel = 0xFFFFFFFF;
constexpr uint32_t kWhite = 0xFFFFFF;

}  // namespace

CellBricks::CellBricks(const glm::ivec3& low, const glm::ivec3& high, const InputFile& file)
    : file_(file) {
    const glm::dvec3 size = glm::dvec3(high) - glm::dvec3(low) + 2.0 * kModelMargin;
    check_listed_span(size, file);
    frame_.size = glm::ivec3(size);
    first_ = low - kModelMargin;
    frame_.origin = glm::dvec3(first_);
    bricks_ = frame_.bricks();
    numbers_.assign(bricks_of(frame_), kNone);
}

uint32_t CellBricks::add_brick() {
    check_listed_bricks(count_ + 1, file_);
    if (!is_counting_) add_cells(1);
    return count_++;
}

void CellBricks::add_cells(size_t bricks) {
    cells_.resize(cells_.size() + bricks * kVoxelsPerBrick, kNoVoxel);
}

void CellBricks::fill_occupancy(const uint32_t* cells, uint64_t* leaves) const {
    for (size_t i = 0; i < kVoxelsPerBrick; ++i) {
        if (cells[i] == kNoVoxel) continue;
        const glm::ivec3 cell = cell_in_brick(i);
        leaves[leaf_in_brick(cell)] |= bit_in_leaf(cell);
    }
}

VoxelModel CellBricks::model() const {
    if (count_ == 0) file_.refuse("has no voxels to show");
    VoxelModel model;
    model.surface = Surface::cubes;
    model.frame = frame_;
    model.slots.assign(numbers_.size(), kBrickOutside);
    model.occupancy.assign(size_t(count_) * kLeavesPerBrick, 0);
    const bool is_white = std::ranges::all_of(
        cells_, [](uint32_t cell) { return cell == kNoVoxel || cell == kWhite; });
    if (!is_white) model.colors.reserve(cells_.size());
    for (size_t brick = 0; brick < numbers_.size(); ++brick) {
        if (numbers_[brick] == kNone) continue;
        const size_t slot = model.coordinates.size();
        model.slots[brick] = uint32_t(slot);
        model.coordinates.push_back(uint32_t(brick));
        const uint32_t* cells = cells_.data() + size_t(numbers_[brick]) * kVoxelsPerBrick;
        fill_occupancy(cells, model.occupancy.data() + slot * kLeavesPerBrick);
        for (size_t i = 0; i < kVoxelsPerBrick && !is_white; ++i) {
            const uint32_t color = cells[i] == kNoVoxel ? kWhite : cells[i];
            model.transparent |= color >> VXL_TRANSPARENCY_SHIFT != 0;
            model.colors.push_back(color);
        }
    }
    return model;
}

}  // namespace voxelume
