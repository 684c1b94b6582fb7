// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/index/index_fields.hpp"

#include <algorithm>
#include <glm/vec4.hpp>
#include <utility>

#include "kernels/shared/voxel.h"
#include "runtime/grid/grid_arguments.hpp"
#include "runtime/grid/sector_table.hpp"
#include "runtime/stages/brick_arrays.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/index/index_parts.hpp"
#include "runtime/stages/index/numbering.hpp"

namespace voxelume {
namespace {

constexpr size_t kCounts = 3;      // counts per brick: voxels, primitives, listed fields
constexpr size_t kEntryWords = 3;  // a brick of a field, its object's rank, its brackets

/// The entries of VXL_UNITED_PARAMETERS of index_fields.cl, and further data of the world's bricks.
struct UnitedBricks {
    std::vector<uint32_t> numbers;     ///< the bricks, ascending
    std::vector<uint32_t> base_slots;  ///< for each: its slot in the base grid or kBrickOutside
    std::vector<uint32_t> first, entries;
    std::vector<uint32_t> bricks_of;  ///< for each brick of each field: its brick of the world
    std::vector<uint32_t> first_of;   ///< for each field: the number of its first brick
};

uint32_t world_brick(const PlacedField& field, uint32_t brick, const glm::ivec3& table) {
    const glm::ivec3 own = field.grid.frame.bricks();
    const int index = int(brick);
    const glm::ivec3 at = field.first_brick +
                          glm::ivec3(index % own.x, index / own.x % own.y, index / (own.x * own.y));
    return uint32_t(at.x + table.x * (at.y + table.y * at.z));
}

/// Lists for each brick the fields' bricks that it consists of, by a counting sort that keeps the
/// fields' order.
void list_entries(const PlacedWorld& world, UnitedBricks& united) {
    united.first.assign(united.numbers.size() + 1, 0);
    for (const uint32_t brick : united.bricks_of)
        if (brick != kBrickOutside) ++united.first[brick + 1];
    for (size_t i = 1; i < united.first.size(); ++i) united.first[i] += united.first[i - 1];
    united.entries.resize(size_t(united.first.back()) * kEntryWords);
    std::vector<uint32_t> next(united.first.begin(), united.first.end() - 1);
    for (size_t field = 0; field < world.fields.size(); ++field)
        for (uint32_t i = united.first_of[field]; i < united.first_of[field + 1]; ++i) {
            if (united.bricks_of[i] == kBrickOutside) continue;
            uint32_t* entry = &united.entries[size_t(next[united.bricks_of[i]]++) * kEntryWords];
            entry[0] = i;
            entry[1] = world.ranks[world.fields[field].object];
            entry[2] = world.fields[field].place.path();
        }
}

UnitedBricks unite_bricks(const PlacedWorld& world, const std::map<uint64_t, VoxelMarks>& marks) {
    const GridFrame& frame = world.voxels.frame;
    const glm::ivec3 table = frame.bricks();
    UnitedBricks united;
    united.first_of.push_back(0);
    for (const PlacedField& field : world.fields) {
        const std::vector<uint32_t> coordinates = field.grid.coordinates.read();
        const VoxelMarks& found = marks.at(field.version);
        for (uint32_t slot = 0; slot < field.grid.brick_count; ++slot)
            united.bricks_of.push_back(found.leaf_mask[slot] == 0
                                           ? kBrickOutside
                                           : world_brick(field, coordinates[slot], table));
        united.first_of.push_back(uint32_t(united.bricks_of.size()));
    }
    const std::vector<uint32_t> base =
        world.voxels.brick_count > 0 ? world.voxels.coordinates.read() : std::vector<uint32_t>();
    united.numbers = united.bricks_of;
    united.numbers.insert(united.numbers.end(), base.begin(),
                          base.begin() + world.voxels.brick_count);
    std::ranges::sort(united.numbers);
    united.numbers.erase(std::unique(united.numbers.begin(), united.numbers.end()),
                         united.numbers.end());
    if (!united.numbers.empty() && united.numbers.back() == kBrickOutside)
        united.numbers.pop_back();
    const auto index_of = [&](uint32_t number) {
        return uint32_t(std::ranges::lower_bound(united.numbers, number) - united.numbers.begin());
    };
    for (uint32_t& brick : united.bricks_of)
        if (brick != kBrickOutside) brick = index_of(brick);
    united.base_slots.assign(united.numbers.size(), kBrickOutside);
    for (uint32_t slot = 0; slot < world.voxels.brick_count; ++slot)
        united.base_slots[index_of(base[slot])] = slot;
    list_entries(world, united);
    return united;
}

/// The united bricks on the device, and the masks of their voxels.
struct UnitedArrays {
    uint32_t count = 0;
    Buffer<uint32_t> numbers, base_slots, first, entries, bricks_of;
    Buffer<uint64_t> masks;                     ///< masks of the fields' leaves
    Buffer<uint64_t> united, listing, of_base;  ///< masks of the world's leaves
};

/// VXL_UNITED_PARAMETERS of index_fields.cl.
void bind(KernelArguments& to, const UnitedArrays& arrays) {
    to.add(arrays.first, arrays.entries, arrays.masks, arrays.united, arrays.listing);
}

UnitedArrays upload(const Device& device, const UnitedBricks& united, bool has_base) {
    const auto words = [&](const char* name, const std::vector<uint32_t>& values) {
        return Buffer<uint32_t>(device, name, values);
    };
    const auto masks = [&](const char* name, size_t bricks) {
        return allocate_masks(device, name, bricks);
    };
    const size_t count = united.numbers.size();
    return {uint32_t(count),
            words("united bricks", united.numbers),
            has_base ? words("base slots", united.base_slots) : Buffer<uint32_t>(),
            words("field starts", united.first),
            words("field entries", united.entries),
            words("bricks of fields", united.bricks_of),
            masks("field masks", united.bricks_of.size()),
            masks("united masks", count),
            masks("list masks", count),
            has_base ? masks("base masks", count) : Buffer<uint64_t>()};
}

Defines features_of(const PlacedWorld& world, const PlacedField* field) {
    const BrickGrid& base = world.voxels;
    const auto has_colors = [](const PlacedField& f) { return !f.grid.colors.empty(); };
    return {{"VXL_BASE", base.brick_count > 0},
            {"VXL_BASE_ATTRIBUTES", !base.attributes.empty()},
            {"VXL_PRIMITIVES", !base.primitive_first.empty()},
            {"VXL_COLORS", !base.colors.empty() || std::ranges::any_of(world.fields, has_colors)},
            {"VXL_VOXEL_NORMALS", !base.normals.empty()},
            {"VXL_LINKED", field && !field->is_first},
            {"VXL_ATTRIBUTES", field && !field->grid.attributes.empty()},
            {"VXL_OWN_COLORS", field && !field->grid.colors.empty()}};
}

/// Numbers the bricks' contents; listed fields come after all voxels.
Numbering number_united(const GridFrame& frame, const UnitedBricks& united,
                        const Buffer<uint64_t>& leaf_masks, const Buffer<uint32_t>& counts) {
    const std::vector<uint64_t> leaf_mask = leaf_masks.read();
    const std::vector<uint32_t> count = counts.read();
    Numbering numbers = number_bricks(frame, {united.numbers, leaf_mask, count, kCounts});
    check_numbers(true, numbers.totals[0] + numbers.totals[2], numbers.totals[1]);
    for (size_t i = kCounts; i < numbers.starts.size(); i += kCounts + 1)
        numbers.starts[i] += uint32_t(numbers.totals[0]);
    return numbers;
}

PyramidParts parts_of(const PlacedWorld& world, const Numbering& numbers) {
    PyramidParts parts{.attributes = true, .fields = true};
    parts.exact = !world.voxels.primitive_first.empty();
    parts.normals = !world.voxels.normals.empty();
    parts.colors = !world.voxels.colors.empty() ||
                   std::ranges::any_of(world.fields, [](const PlacedField& field) {
                       return !field.grid.colors.empty();
                   });
    parts.listed_fields = numbers.totals[2];
    return parts;
}

}  // namespace

/// Finds the voxels of new fields, and forgets those of fields that are gone.
void FieldIndexer::mark(const PlacedWorld& world) {
    std::map<uint64_t, VoxelMarks> before = std::exchange(marks_, {});
    for (const PlacedField& field : world.fields) {
        const auto found = before.find(field.version);
        if (found != before.end()) {
            marks_.insert(before.extract(found));
            continue;
        }
        const ProgramFile files[] = {{"index.cl", index_defines(field.grid)},
                                     {"index_fields.cl", features_of(world, &field)}};
        Program::build_together(device_, files);
        marks_.emplace(field.version, mark_grid(device_, field.grid));
    }
}

Pyramid FieldIndexer::index(const PlacedWorld& world) {
    mark(world);
    const BrickGrid& base = world.voxels;
    const UnitedBricks bricks = unite_bricks(world, marks_);
    const UnitedArrays arrays = upload(device_, bricks, base.brick_count > 0);
    const Program program(device_, "index_fields.cl", features_of(world, nullptr));
    for (size_t field = 0; field < world.fields.size(); ++field) {
        const uint32_t first = bricks.first_of[field],
                       leaves = (bricks.first_of[field + 1] - first) * 64;
        program.kernel("append_masks")
            .launch(WorkItem::light, leaves, leaves, first,
                    marks_.at(world.fields[field].version).masks, arrays.masks);
    }
    if (has_parts(world)) join_parts(device_, program, world, bricks.first_of, arrays.masks);
    const Buffer<uint64_t> leaf_masks(device_, "united leaf masks", arrays.count);
    const Buffer<uint32_t> counts(device_, "united counts", arrays.count * kCounts);
    program.kernel("unite_marks")
        .launch(WorkItem::heavy, arrays.count, arrays.count, base, arrays.numbers,
                arrays.base_slots, Buffer<uint32_t>(device_, "ranks", world.ranks), arrays,
                arrays.of_base, leaf_masks, counts);
    const Numbering numbers = number_united(base.frame, bricks, leaf_masks, counts);
    Pyramid pyramid = allocate_pyramid(device_, base, parts_of(world, numbers),
                                       {numbers.bricks.size() / kWordsPerRecord / kRecordsPerSector,
                                        numbers.leaf_count, numbers.totals[0], numbers.totals[1]});
    pyramid.has_chains = has_parts(world) && pyramid.listed_fields > 0;
    pyramid.chain_depth = pyramid.has_chains ? chain_depth(world) : 0;
    pyramid.sectors.write(numbers.sectors);
    pyramid.bricks.write(numbers.bricks);
    const Buffer<uint32_t> starts(device_, "index starts", numbers.starts);
    program.kernel("write_united")
        .launch(WorkItem::heavy, arrays.count, arrays.count, base, arrays.base_slots, arrays,
                arrays.of_base, starts, WrittenVoxels{pyramid});
    for (size_t i = 0; i < world.fields.size(); ++i) {
        const PlacedField& field = world.fields[i];
        pyramid.transparent |= field.grid.transparent;
        Program(device_, "index_fields.cl", features_of(world, &field))
            .kernel("write_fields")
            .launch(WorkItem::heavy, field.grid.brick_count, field.grid.brick_count,
                    bricks.first_of[i], field.place.links(), field.grid, arrays.bricks_of, arrays,
                    starts, pyramid.attributes, pyramid.colors, pyramid.fields);
    }
    const auto end = uint32_t(numbers.totals[1]);
    if (!pyramid.primitive_first.empty())
        pyramid.primitive_first.write(std::span(&end, 1), pyramid.voxel_count);
    return pyramid;
}

}  // namespace voxelume
