// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxels/vox_cells.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <glm/common.hpp>
#include <span>
#include <utility>

#include "runtime/base/files/input_file.hpp"
#include "runtime/base/huge_pages.hpp"
#include "runtime/base/ranges.hpp"
#include "runtime/io/voxels/marked_cells.hpp"
#include "runtime/io/voxels/voxel_limits.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kNoBrick = 0xFFFFFFFF;
constexpr size_t kBlock = 1 << 16;           // voxels read at once, which stay in the cache
constexpr uint32_t kCoordinates = 0xFFFFFF;  // the bits of a listed voxel that aren't its colour
// Below these numbers, starting a thread takes longer than the work.
constexpr size_t kManyVoxels = 1 << 19, kManyBricks = 1 << 8;

/// The map from a model's voxels: voxel v fills [first + R v, first + R v + 1] in Y-up coordinates.
/// R is a signed permutation.
struct CellMap {
    VoxRotation rotation;
    glm::ivec3 first{0};
};

CellMap cell_map(const VoxStanding& standing) {
    const VoxRotation r = kVoxYUp * standing.rotation;
    const glm::ivec3 pivot = standing.model->size / 2;
    CellMap map{r, kVoxYUp * standing.translation - r * pivot};
    // A mirrored axis starts at the other end.
    for (int row = 0; row < 3; ++row)
        if (r.sign[size_t(row)] < 0) --map.first[row];
    return map;
}

/// Appends the value of each cell of a brick.
void append_values(const std::array<uint32_t, 256>& values, const uint8_t* cells,
                   std::vector<uint32_t>& to) {
    // A brick is completed while it stays in the cache, so memory is written once.
    std::array<uint32_t, kVoxelsPerBrick> words;
    for (size_t i = 0; i < kVoxelsPerBrick; ++i) words[i] = values[cells[i]];
    to.insert(to.end(), words.begin(), words.end());
}

/// Calls `use(first, end)` for ranges of bricks, in parallel where there are many.
template <class Use>
void for_brick_ranges(size_t count, const Use& use) {
    if (count >= kManyBricks)
        for_ranges(int(count), count * kVoxelsPerBrick, use);
    else
        use(0, int(count));
}

/// The step from a voxel of the file to the next one.
struct Row {
    bool is_one = false;  ///< the voxels are neighbours along an axis
    size_t axis = 0;
    bool is_up = true;
};

/// The step for a difference of coordinates with one byte each.
Row row_along(uint32_t difference) {
    for (size_t axis = 0; axis < 3; ++axis) {
        const uint32_t one = uint32_t{1} << 8 * axis;
        if (difference == one) return {true, axis, true};
        if (difference == ((0u - one) & 0xFFFFFF)) return {true, axis, false};
    }
    return {};
}

}  // namespace

CellBox box_of(const VoxStanding& standing) {
    const CellMap map = cell_map(standing);
    const glm::ivec3 a = map.first, b = map.first + map.rotation * (standing.model->size - 1);
    return {glm::min(a, b), glm::max(a, b) + 1};
}

VoxCells::VoxCells(const CellBox& box, const InputFile& file) : file_(file) {
    const glm::dvec3 size = glm::dvec3(box.high - box.low) + 2.0 * kModelMargin;
    check_listed_span(size, file);
    frame_.size = glm::ivec3(size);
    first_ = box.low - kModelMargin;
    frame_.origin = glm::dvec3(first_);
    numbers_.assign(bricks_of(frame_), kNoBrick);
}

void VoxCells::add_box(const CellBox& box) {
    const glm::ivec3 low = (box.low - first_) / kBrickSize,
                     high = (box.high - 1 - first_) / kBrickSize, bricks = frame_.bricks();
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) {
                uint32_t& number =
                    numbers_[size_t(x) + size_t(bricks.x) * size_t(y + bricks.y * z)];
                if (number == kNoBrick) number = count_++;
            }
    check_stored_bricks(count_, file_);
}

void VoxCells::allocate() {
    reserve_in_huge_pages(cells_, size_t(count_) * kVoxelsPerBrick);
    cells_.resize(size_t(count_) * kVoxelsPerBrick);
    for_brick_ranges(count_, [&](int first, int end) {
        std::memset(cells_.data() + size_t(first) * kVoxelsPerBrick, 0,
                    size_t(end - first) * kVoxelsPerBrick);
    });
}

/// Each row of the map depends on one coordinate alone.
VoxCells::Steps VoxCells::steps_of(const VoxStanding& standing) const {
    const CellMap map = cell_map(standing);
    const glm::ivec3 bricks = frame_.bricks();
    const glm::ivec3 brick_stride(1, bricks.x, bricks.x * bricks.y), cell_stride(1, 16, 256);
    Steps steps;
    for (int row = 0; row < 3; ++row) {
        const size_t axis = size_t(map.rotation.axis[size_t(row)]);
        const int sign = map.rotation.sign[size_t(row)];
        steps.stride[axis] = sign * cell_stride[row];
        for (int v = 0; v < standing.model->size[int(axis)]; ++v) {
            const int at = map.first[row] + sign * v - first_[row];
            steps.of[axis][size_t(v)] = {uint32_t(at / kBrickSize * brick_stride[row]),
                                         uint32_t(at % kBrickSize * cell_stride[row])};
        }
    }
    return steps;
}

size_t VoxCells::Steps::room(size_t axis, uint32_t coordinate, bool is_up) const {
    const uint32_t in_brick = of[axis][coordinate].cell / uint32_t(std::abs(stride[axis]));
    return is_up == (stride[axis] > 0) ? kBrickSize - in_brick : in_brick + 1;
}

/// Adds a block of voxels. Files list most voxels in rows, up or down some axis: within a brick the
/// index of one leads to the next. 16.8 M voxels take 20 ms instead of 65.
size_t VoxCells::add_block(const std::vector<uint32_t>& block, size_t count, const Steps& steps,
                           const glm::ivec3& size) {
    size_t empty = 0;
    for (size_t i = 0; i < count;) {
        const uint32_t v = block[i];
        const std::array<uint32_t, 3> at = {v & 255, v >> 8 & 255, v >> 16 & 255};
        if (int(at[0]) >= size.x || int(at[1]) >= size.y || int(at[2]) >= size.z)
            file_.refuse(fmt::format("a voxel lies outside of its model, which has {} x {} x {}",
                                     size.x, size.y, size.z));
        const Step &x = steps.of[0][at[0]], &y = steps.of[1][at[1]], &z = steps.of[2][at[2]];
        uint8_t* cell = cells_.data() +
                        size_t(numbers_[x.brick + y.brick + z.brick]) * kVoxelsPerBrick +
                        (x.cell + y.cell + z.cell);
        const uint32_t step = i + 1 < count ? (block[i + 1] - v) & kCoordinates : 0;
        const Row row = row_along(step);
        size_t end = i + 1;
        std::ptrdiff_t stride = 0;
        if (row.is_one) {
            const uint32_t to_side =
                row.is_up ? uint32_t(size[int(row.axis)]) - at[row.axis] : at[row.axis] + 1;
            end = i + std::min({size_t(to_side), steps.room(row.axis, at[row.axis], row.is_up),
                                count - i});
            stride = row.is_up ? steps.stride[row.axis] : -steps.stride[row.axis];
        }
        uint32_t expected = v & kCoordinates;
        for (; i < end && (block[i] & kCoordinates) == expected; ++i) {
            const uint32_t index = block[i] >> 24;
            // Another thread may write the same cell; add_together() detects that later.
            if (index != 0)
                std::atomic_ref(*cell).store(uint8_t(index), std::memory_order_relaxed);
            else
                ++empty;
            cell += stride;
            expected = (expected + step) & kCoordinates;
        }
    }
    return count - empty;
}

size_t VoxCells::add_range(const VoxModel& model, const Steps& steps, size_t first, size_t end) {
    std::vector<uint32_t> block(std::min(kBlock, end - first));
    size_t added = 0;
    for (; first < end; first += block.size()) {
        const size_t count = std::min(block.size(), end - first);
        file_.read(model.voxels_at + 4 * first, block.data(), 4 * count);
        added += add_block(block, count, steps, model.size);
    }
    return added;
}

size_t VoxCells::mark_all() {
    leaves_.resize(size_t(count_) * kLeavesPerBrick);
    std::atomic<size_t> filled = 0;
    for_brick_ranges(count_, [&](int first, int end) {
        size_t sum = 0;
        for (size_t brick = size_t(first); brick < size_t(end); ++brick)
            sum += mark_voxels(cells_.data() + brick * kVoxelsPerBrick,
                               leaves_.data() + brick * kLeavesPerBrick);
        filled += sum;
    });
    return filled;
}

bool VoxCells::add_together(const VoxModel& model, const Steps& steps) {
    std::atomic<size_t> added = 0;
    for_ranges(int((model.voxels + kBlock - 1) / kBlock), model.voxels, [&](int first, int end) {
        added += add_range(model, steps, kBlock * size_t(first),
                           std::min(kBlock * size_t(end), size_t(model.voxels)));
    });
    if (added == mark_all()) return true;
    std::ranges::fill(cells_, uint8_t{0});
    return false;
}

/// True if most of the voxels in the middle of a model's list lie in rows. Otherwise threads would
/// write all over the cells, and together take longer than one thread alone.
bool VoxCells::lies_in_rows(const VoxModel& model) const {
    std::vector<uint32_t> some(std::min(kBlock / 16, size_t(model.voxels)));
    file_.read(model.voxels_at + 4 * ((model.voxels - some.size()) / 2), some.data(),
               4 * some.size());
    size_t in_rows = 0;
    for (size_t i = 1; i < some.size(); ++i)
        in_rows += row_along((some[i] - some[i - 1]) & kCoordinates).is_one;
    return in_rows > some.size() / 2;
}

/// Adds the voxels: in several threads if that pays and none share a cell, else in order. The last
/// of those that share a cell counts, and threads can't tell which one that is.
void VoxCells::add_voxels(const VoxStanding& standing) {
    const VoxModel& model = *standing.model;
    const Steps steps = steps_of(standing);
    const bool is_first = std::exchange(is_untouched_, false);
    const bool is_parted = is_first && model.voxels >= kManyVoxels && lies_in_rows(model);
    if (is_parted && add_together(model, steps)) return;
    leaves_.clear();
    add_range(model, steps, 0, model.voxels);
}

std::array<bool, 256> VoxCells::used() const {
    std::array<bool, 256> used{};
    for (const uint8_t cell : cells_) used[cell] = true;
    used[0] = false;
    return used;
}

void VoxCells::fill(const std::array<uint32_t, 256>& groups, bool has_groups,
                    VoxelModel& model) && {
    model.frame = frame_;
    model.slots.assign(numbers_.size(), kBrickOutside);
    if (leaves_.empty()) mark_all();
    std::vector<const uint8_t*> bricks;  // by slot
    bool is_in_order = true;
    for (size_t brick = 0; brick < numbers_.size(); ++brick) {
        const size_t number = numbers_[brick];
        if (number == kNoBrick) continue;
        const auto leaves = std::span(leaves_).subspan(number * kLeavesPerBrick, kLeavesPerBrick);
        if (std::ranges::all_of(leaves, [](uint64_t leaf) { return leaf == 0; })) continue;
        is_in_order &= number == bricks.size();
        model.slots[brick] = uint32_t(bricks.size());
        model.coordinates.push_back(uint32_t(brick));
        model.occupancy.insert(model.occupancy.end(), leaves.begin(), leaves.end());
        bricks.push_back(cells_.data() + number * kVoxelsPerBrick);
    }
    if (has_groups) reserve_in_huge_pages(model.attributes, bricks.size() * kVoxelsPerBrick);
    if (has_groups)
        for (const uint8_t* cells : bricks) append_values(groups, cells, model.attributes);
    if (!is_in_order) {
        reserve_in_huge_pages(model.color_codes, bricks.size() * kVoxelsPerBrick);
        for (const uint8_t* cells : bricks)
            model.color_codes.insert(model.color_codes.end(), cells, cells + kVoxelsPerBrick);
        return;
    }
    cells_.resize(bricks.size() * kVoxelsPerBrick);
    model.color_codes = std::move(cells_);
}

}  // namespace voxelume
