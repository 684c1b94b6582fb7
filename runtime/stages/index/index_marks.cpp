// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/index/index_marks.hpp"

#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <utility>

#include "runtime/grid/grid_arguments.hpp"
#include "runtime/stages/brick_arrays.hpp"

namespace voxelume {
namespace {

/// Marks the bricks in the slots `listed`, or all bricks if it is empty. The leaf masks and counts
/// of the result are in that order.
VoxelMarks mark_listed(const Device& device, const Program& program, const BrickGrid& grid,
                       const std::vector<uint32_t>& listed, Buffer<uint64_t> masks) {
    const uint32_t count = listed.empty() ? grid.brick_count : uint32_t(listed.size());
    VoxelMarks marks;
    marks.masks = std::move(masks);
    const MarkArrays arrays = allocate_marks(device, count);
    const auto& [leaf_mask, counts] = arrays;
    program.kernel("mark_voxels")
        .launch(WorkItem::heavy, count, count, Buffer<uint32_t>(device, "marked bricks", listed),
                grid, marks.masks, leaf_mask, counts);
    marks.leaf_mask = leaf_mask.read();
    marks.counts = counts.read();
    return marks;
}

/// Calls `visit` with the indices of a brick and its neighbours.
template <class Visit>
void for_neighbours(const glm::ivec3& table, uint32_t number, const Visit& visit) {
    const int index = int(number);
    const glm::ivec3 at(index % table.x, index / table.x % table.y, index / (table.x * table.y));
    const glm::ivec3 low = glm::max(at - 1, glm::ivec3(0)), high = glm::min(at + 1, table - 1);
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x)
                visit(size_t(x) + size_t(table.x) * (size_t(y) + size_t(table.y) * size_t(z)));
}

}  // namespace

MarkArrays allocate_marks(const Device& device, size_t bricks) {
    return {Buffer<uint64_t>(device, "index leaf masks", bricks),
            Buffer<uint32_t>(device, "index counts", 2 * bricks)};
}

VoxelMarks mark_voxels(const Device& device, const Program& program, const BrickGrid& grid) {
    return mark_listed(device, program, grid, {},
                       allocate_masks(device, "index masks", grid.brick_count));
}

VoxelMarks mark_changed_voxels(const Device& device, const Program& program, const BrickGrid& grid,
                               const std::vector<uint32_t>& changed, VoxelMarks before) {
    std::vector<bool> reached(before.slots.size());
    for (const uint32_t number : changed)
        for_neighbours(grid.frame.bricks(), number, [&](size_t brick) { reached[brick] = true; });
    const std::vector<uint32_t> coordinates = grid.coordinates.read();
    std::vector<uint64_t> leaf_mask(grid.brick_count);
    std::vector<uint32_t> counts(size_t(grid.brick_count) * 2), listed, moves;
    for (uint32_t slot = 0; slot < grid.brick_count; ++slot) {
        const uint32_t number = coordinates[slot], old = before.slots[number];
        if (reached[number]) {
            listed.push_back(slot);
            continue;
        }
        // A mask may only move from a slot that is no longer used to one that is in use: otherwise
        // it might be overwritten before it is read.
        if (old >= kBrickInside || (old != slot && old < grid.brick_count))
            return mark_voxels(device, program, grid);
        leaf_mask[slot] = before.leaf_mask[old];
        counts[slot * 2] = before.counts[old * 2];
        counts[slot * 2 + 1] = before.counts[old * 2 + 1];
        if (old != slot) moves.insert(moves.end(), {old, slot});
    }
    Buffer<uint64_t> masks = std::move(before.masks);
    if (masks.size() < size_t(grid.brick_count) * 64) {
        Buffer<uint64_t> larger(device, "index masks", size_t(grid.brick_count) * 80);
        larger.copy(masks);
        masks = std::move(larger);
    }
    const auto moved = uint32_t(moves.size() / 2 * 64);
    program.kernel("move_masks")
        .launch(WorkItem::light, moved, moved, Buffer<uint32_t>(device, "moved masks", moves),
                masks);
    VoxelMarks marks;
    if (listed.empty()) {
        marks.masks = std::move(masks);
    } else {
        marks = mark_listed(device, program, grid, listed, std::move(masks));
        for (size_t i = 0; i < listed.size(); ++i) {
            leaf_mask[listed[i]] = marks.leaf_mask[i];
            counts[listed[i] * 2] = marks.counts[i * 2];
            counts[listed[i] * 2 + 1] = marks.counts[i * 2 + 1];
        }
    }
    marks.leaf_mask = std::move(leaf_mask);
    marks.counts = std::move(counts);
    return marks;
}

}  // namespace voxelume
