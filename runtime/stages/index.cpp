#include "runtime/stages/index.hpp"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <bit>
#include <utility>

#include "kernels/shared/voxel.h"
#include "runtime/error.hpp"
#include "runtime/stages/index_marks.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kEmptyCube = 0x80000000u;
constexpr size_t kRecordsPerSector = 64;
constexpr size_t kWordsPerRecord = 4;
constexpr int kBricksPerSector = kSectorSize / kBrickSize;

/// The pyramid's upper levels, and where each slot's leaves, voxels and primitives start.
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

/// Sector of brick `b` in the table, and the bit of the brick in it.
glm::uvec2 sector_and_bit(const glm::ivec3& b, const glm::ivec3& sectors) {
    const glm::ivec3 s = b / kBricksPerSector, in = b % kBricksPerSector;
    return {s.x + sectors.x * (s.y + sectors.y * s.z), in.x | in.y << 2 | in.z << 4};
}

/// For every cell of a table, whether the aligned group of `edge`³ cells around it is empty.
template <class IsEmpty>
std::vector<bool> empty_groups(const glm::ivec3& size, int edge, const IsEmpty& is_empty) {
    const glm::ivec3 groups = (size + edge - 1) / edge;
    std::vector<bool> empty(size_t(groups.x) * groups.y * groups.z, true);
    std::vector<bool> result(size_t(size.x) * size.y * size.z);
    const auto for_each_cell = [&](auto&& visit) {
        size_t cell = 0;
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x, ++cell)
                    visit(cell, size_t(x / edge) +
                                    size_t(groups.x) *
                                        (size_t(y / edge) + size_t(groups.y) * size_t(z / edge)));
    };
    for_each_cell([&](size_t cell, size_t group) {
        if (!is_empty(cell)) empty[group] = false;
    });
    for_each_cell([&](size_t cell, size_t group) { result[cell] = empty[group]; });
    return result;
}

/// Numbers the sectors that hold voxels in ascending order; the others get their empty cube.
/// Returns how many hold voxels.
uint32_t number_sectors(const glm::ivec3& size, const std::vector<bool>& occupied,
                        std::vector<uint32_t>& sectors) {
    const std::vector<bool> far_empty =
        empty_groups(size, 4, [&](size_t sector) { return !occupied[sector]; });
    uint32_t block = 0;
    for (size_t sector = 0; sector < sectors.size(); ++sector)
        sectors[sector] = occupied[sector] ? block++ : kEmptyCube | (far_empty[sector] ? 8u : 6u);
    return block;
}

/// Gives every empty brick record the size of its empty cube.
void write_empty_cubes(std::vector<uint32_t>& bricks) {
    constexpr uint64_t kGroup = 0x0000000000330033ull;  // the bits of 2³ aligned bricks
    for (size_t first = 0; first < bricks.size(); first += kRecordsPerSector * kWordsPerRecord) {
        uint64_t occupied = 0;
        for (size_t bit = 0; bit < kRecordsPerSector; ++bit) {
            const uint32_t* record = &bricks[first + bit * kWordsPerRecord];
            if (record[0] | record[1]) occupied |= uint64_t{1} << bit;
        }
        for (size_t bit = 0; bit < kRecordsPerSector; ++bit) {
            if (occupied >> bit & 1) continue;
            const bool group_empty = (occupied >> (bit & 0b101010) & kGroup) == 0;
            uint32_t* record = &bricks[first + bit * kWordsPerRecord];
            record[2] = record[3] = kEmptyCube | (group_empty ? 5u : 4u);
        }
    }
}

Numbering number_voxels(const BrickGrid& grid, const VoxelMarks& marks) {
    const glm::ivec3 brick_table = grid.frame.bricks(), sector_table = grid.frame.sectors();
    const std::vector<uint32_t> coordinates = grid.coordinates.read();
    Numbering numbers;
    numbers.sectors.resize(size_t(sector_table.x) * sector_table.y * sector_table.z);
    std::vector<bool> occupied(numbers.sectors.size());
    std::vector<glm::uvec2> places(grid.brick_count);  // sector, bit
    for (size_t slot = 0; slot < places.size(); ++slot) {
        if (marks.leaf_mask[slot] == 0) continue;  // perhaps a brick of nodes beyond all voxels
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
    if (std::max(voxels, primitives) > UINT32_MAX)
        throw Error(ErrorKind::limit,
                    "this world has {} surface voxels and {} primitives in them, at most {} can be "
                    "numbered: use larger voxels",
                    voxels, primitives, UINT32_MAX);
    numbers.leaf_count = uint32_t(leaves);
    numbers.voxel_count = uint32_t(voxels);
    numbers.primitive_count = uint32_t(primitives);
    return numbers;
}

Surface occupied_kind(const BrickGrid& grid) {
    return grid.primitive_first.empty() ? Surface::cubes : Surface::exact;
}

Pyramid allocate(const Device& device, const BrickGrid& grid, const Numbering& numbers) {
    const size_t voxels = numbers.voxel_count;
    const bool exact = !grid.primitive_first.empty();
    const Surface kind = grid.distance.empty() ? occupied_kind(grid) : Surface::smooth;
    Pyramid pyramid;
    pyramid.frame = grid.frame;
    pyramid.leaf_count = numbers.leaf_count;
    pyramid.voxel_count = numbers.voxel_count;
    pyramid.sectors = Buffer<uint32_t>(device, "sectors", numbers.sectors);
    pyramid.bricks = Buffer<uint32_t>(device, "brick records", numbers.bricks);
    pyramid.leaves = Buffer<uint32_t>(device, "leaves", size_t(numbers.leaf_count) * 2);
    pyramid.leaf_voxels = Buffer<uint32_t>(device, "leaf voxels", numbers.leaf_count);
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
        pyramid.primitives = Buffer<uint32_t>(device, "primitives", numbers.primitive_count);
    }
    pyramid.triangles = grid.triangles;
    pyramid.triangle_attributes = grid.triangle_attributes;
    pyramid.solids = grid.solids;
    return pyramid;
}

}  // namespace

namespace {

/// The pyramid of a grid whose voxels are marked.
Pyramid write_pyramid(const Device& device, const Program& program, const BrickGrid& grid,
                      const VoxelMarks& marks) {
    const Numbering numbers = number_voxels(grid, marks);
    Pyramid pyramid = allocate(device, grid, numbers);
    const glm::uvec2 kinds{static_cast<uint32_t>(occupied_kind(grid)) << VXL_KIND_SHIFT,
                           VXL_KIND_SMOOTH << VXL_KIND_SHIFT};
    const Buffer<uint32_t> starts(device, "index starts", numbers.starts);
    program.kernel("write_voxels")
        .launch(WorkItem::heavy, grid.brick_count, grid.brick_count, kinds, grid.attribute,
                glm::ivec4(grid.frame.bricks(), 0), grid.slots, grid.coordinates, grid.occupancy,
                grid.distance, grid.attributes, grid.colors, grid.primitive_first, grid.primitives,
                marks.masks, starts, pyramid.leaves, pyramid.leaf_voxels, pyramid.attributes,
                pyramid.colors, pyramid.fields, pyramid.primitive_first, pyramid.primitives);
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
};

Indexer::Indexer(const Device& device) : device_(device) {}
Indexer::~Indexer() = default;
Indexer::Indexer(Indexer&&) noexcept = default;
Indexer& Indexer::operator=(Indexer&&) noexcept = default;

Pyramid Indexer::index(const BrickGrid& grid, const std::vector<uint32_t>* changed) {
    const Program program(device_, "index.cl", features(grid));
    std::unique_ptr<Kept> before = std::move(kept_);
    const bool goes_on = before && changed && grid.primitive_first.empty();
    VoxelMarks marks =
        goes_on ? mark_changed_voxels(device_, program, grid, *changed, std::move(before->marks))
                : mark_voxels(device_, program, grid);
    Pyramid pyramid = write_pyramid(device_, program, grid, marks);
    if (grid.primitive_first.empty()) {
        marks.slots = grid.slots.read();
        kept_ = std::make_unique<Kept>(Kept{std::move(marks)});
    }
    return pyramid;
}

}  // namespace voxelume
