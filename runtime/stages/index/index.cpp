// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/index/index.hpp"

#include <glm/vec4.hpp>

#include <algorithm>
#include <bit>
#include <utility>

#include "kernels/shared/voxel.h"
#include "runtime/base/error.hpp"
#include "runtime/grid/grid_arguments.hpp"
#include "runtime/grid/sector_table.hpp"
#include "runtime/stages/index/index_marks.hpp"

namespace voxelume {
namespace {

/// The entries of the pyramid's upper levels, and where each slot's leaves, voxels and primitives
/// start.
struct Numbering {
    std::vector<uint32_t> sectors, bricks;
    std::vector<uint32_t> starts;  ///< 3 per slot: first leaf, voxel, primitive
    uint32_t leaf_count = 0, voxel_count = 0, primitive_count = 0;
};

bool has_two_sorts(const BrickGrid& grid) {
    return !grid.occupancy.empty() && !grid.distance.empty();
}

Defines features(const BrickGrid& grid) {
    return {{"VXL_OCCUPANCY", !grid.occupancy.empty()},
            {"VXL_SMOOTH", !grid.distance.empty()},
            {"VXL_ATTRIBUTES", !grid.attributes.empty()},
            {"VXL_WRITE_ATTRIBUTES", !grid.attributes.empty() || has_two_sorts(grid)},
            {"VXL_COLORS", !grid.colors.empty()},
            {"VXL_PRIMITIVES", !grid.primitive_first.empty()}};
}

Numbering number_voxels(const BrickGrid& grid, const VoxelMarks& marks) {
    const glm::ivec3 brick_table = grid.frame.bricks(), sector_table = grid.frame.sectors();
    const std::vector<uint32_t> coordinates = grid.coordinates.read();
    Numbering numbers;
    numbers.sectors.resize(size_t(sector_table.x) * sector_table.y * sector_table.z);
    std::vector<bool> occupied(numbers.sectors.size());
    std::vector<glm::uvec2> places(grid.brick_count);  // sector, bit
    for (size_t slot = 0; slot < places.size(); ++slot) {
        if (marks.leaf_mask[slot] == 0) continue;  // such a brick may hold nodes beyond all voxels
        const int index = int(coordinates[slot]);
        places[slot] = sector_and_bit({index % brick_table.x, index / brick_table.x % brick_table.y,
                                       index / (brick_table.x * brick_table.y)},
                                      sector_table);
        occupied[places[slot].x] = true;
    }
    const uint32_t blocks = number_sectors(sector_table, occupied, numbers.sectors);
    std::vector<uint32_t> slot_of_record(blocks * kRecordsPerSector, kBrickOutside);
    for (size_t slot = 0; slot < places.size(); ++slot)
        if (marks.leaf_mask[slot] != 0)
            slot_of_record[numbers.sectors[places[slot].x] * kRecordsPerSector + places[slot].y] =
                uint32_t(slot);

    numbers.starts.resize(size_t(grid.brick_count) * 3);
    numbers.bricks.resize(slot_of_record.size() * kWordsPerRecord);
    uint64_t leaves = 0, voxels = 0, primitives = 0;
    for (size_t record = 0; record < slot_of_record.size(); ++record) {
        const size_t slot = slot_of_record[record];
        if (slot == kBrickOutside) continue;
        const uint64_t mask = marks.leaf_mask[slot];
        uint32_t* words = &numbers.bricks[record * kWordsPerRecord];
        words[0] = uint32_t(mask);
        words[1] = uint32_t(mask >> 32);
        words[2] = uint32_t(leaves);
        words[3] = uint32_t(leaves) + uint32_t(std::popcount(words[0]));
        uint32_t* start = &numbers.starts[slot * 3];
        start[0] = uint32_t(leaves);
        start[1] = uint32_t(voxels);
        start[2] = uint32_t(primitives);
        leaves += size_t(std::popcount(mask));
        voxels += marks.counts[slot * 2];
        primitives += marks.counts[slot * 2 + 1];
    }
    write_empty_cubes(numbers.bricks);
    // Kernels gather by signed indices: two words for each leaf, or eight for each field.
    const uint64_t maximum = grid.distance.empty() ? uint64_t{1} << 30 : uint64_t{1} << 28;
    if (std::max(voxels, primitives) > maximum)
        throw Error(ErrorKind::limit,
                    "this world has {} surface voxels and {} primitives in them, at most {} can be "
                    "numbered: use larger voxels",
                    voxels, primitives, maximum);
    numbers.leaf_count = uint32_t(leaves);
    numbers.voxel_count = uint32_t(voxels);
    numbers.primitive_count = uint32_t(primitives);
    return numbers;
}

Surface occupied_kind(const BrickGrid& grid) {
    return grid.primitive_first.empty() ? Surface::cubes : Surface::exact;
}

Pyramid upload(const Device& device, const BrickGrid& grid, const Numbering& numbers) {
    Pyramid pyramid =
        allocate_pyramid(device, grid,
                         {numbers.bricks.size() / kWordsPerRecord / kRecordsPerSector,
                          numbers.leaf_count, numbers.voxel_count, numbers.primitive_count});
    pyramid.sectors.write(numbers.sectors);
    pyramid.bricks.write(numbers.bricks);
    return pyramid;
}

}  // namespace

Pyramid allocate_pyramid(const Device& device, const BrickGrid& grid, const PyramidCounts& counts) {
    const size_t voxels = counts.voxels;
    const bool exact = !grid.primitive_first.empty();
    const Surface kind = grid.distance.empty() ? occupied_kind(grid) : Surface::smooth;
    const glm::ivec3 sectors = grid.frame.sectors();
    Pyramid pyramid;
    pyramid.frame = grid.frame;
    pyramid.leaf_count = uint32_t(counts.leaves);
    pyramid.voxel_count = uint32_t(voxels);
    pyramid.sectors = Buffer<uint32_t>(device, "sectors",
                                       size_t(sectors.x) * size_t(sectors.y) * size_t(sectors.z));
    pyramid.bricks = Buffer<uint32_t>(device, "brick records",
                                      counts.sectors * kRecordsPerSector * kWordsPerRecord);
    pyramid.leaves = Buffer<uint32_t>(device, "leaves", counts.leaves * 2);
    pyramid.leaf_voxels = Buffer<uint32_t>(device, "leaf voxels", counts.leaves);
    if (!grid.attributes.empty() || has_two_sorts(grid))
        pyramid.attributes = Buffer<uint32_t>(device, "voxel attributes", voxels);
    else
        pyramid.attribute = (grid.attribute & ~(~0u << VXL_KIND_SHIFT)) |
                            static_cast<uint32_t>(kind) << VXL_KIND_SHIFT;
    pyramid.transparent = grid.transparent;
    if (!grid.colors.empty()) pyramid.colors = Buffer<uint32_t>(device, "voxel colors", voxels);
    if (!grid.distance.empty())
        pyramid.fields = Buffer<uint32_t>(device, "voxel fields", voxels * VXL_FIELD_WORDS);
    if (exact) {
        pyramid.primitive_first = Buffer<uint32_t>(device, "primitive starts", voxels + 1);
        pyramid.primitives = Buffer<uint32_t>(device, "primitives", counts.primitives);
    }
    pyramid.triangles = grid.triangles;
    pyramid.triangle_attributes = grid.triangle_attributes;
    pyramid.triangle_normals = grid.triangle_normals;
    pyramid.solids = grid.solids;
    return pyramid;
}

namespace {

/// The pyramid of a grid whose voxels are marked.
Pyramid write_pyramid(const Device& device, const Program& program, const BrickGrid& grid,
                      const VoxelMarks& marks) {
    const Numbering numbers = number_voxels(grid, marks);
    Pyramid pyramid = upload(device, grid, numbers);
    const glm::uvec2 kinds{static_cast<uint32_t>(occupied_kind(grid)) << VXL_KIND_SHIFT,
                           VXL_KIND_SMOOTH << VXL_KIND_SHIFT};
    const Buffer<uint32_t> starts(device, "index starts", numbers.starts);
    program.kernel("write_voxels")
        .launch(WorkItem::heavy, grid.brick_count, grid.brick_count, kinds, grid, marks.masks,
                starts, pyramid.leaves, pyramid.leaf_voxels, pyramid.attributes, pyramid.colors,
                pyramid.fields, pyramid.primitive_first, pyramid.primitives);
    if (!pyramid.primitive_first.empty())
        pyramid.primitive_first.write(std::span(&numbers.primitive_count, 1), numbers.voxel_count);
    return pyramid;
}

}  // namespace

Pyramid build_index(const Device& device, const BrickGrid& grid) {
    const Program program(device, "index.cl", features(grid));
    return write_pyramid(device, program, grid, mark_voxels(device, program, grid));
}

struct Indexer::Kept {
    VoxelMarks marks;
    Pyramid pyramid;
};

Indexer::Indexer(const Device& device) : device_(device) {}
Indexer::~Indexer() = default;
Indexer::Indexer(Indexer&&) noexcept = default;
Indexer& Indexer::operator=(Indexer&&) noexcept = default;

Pyramid Indexer::index(const BrickGrid& grid, const std::vector<uint32_t>* changed) {
    if (kept_ && changed && changed->empty()) return kept_->pyramid;
    const Program program(device_, "index.cl", features(grid));
    std::unique_ptr<Kept> before = std::move(kept_);
    if (before) before->pyramid = {};
    VoxelMarks marks = before && changed ? mark_changed_voxels(device_, program, grid, *changed,
                                                               std::move(before->marks))
                                         : mark_voxels(device_, program, grid);
    Pyramid pyramid = write_pyramid(device_, program, grid, marks);
    marks.slots = grid.slots.read();
    kept_ = std::make_unique<Kept>(Kept{std::move(marks), pyramid});
    return pyramid;
}

}  // namespace voxelume
