// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/index/index_parts.hpp"

#include <algorithm>
#include <span>

#include "runtime/stages/brick_arrays.hpp"

namespace voxelume {
namespace {

constexpr size_t kChainWords = 3;

/// The parts in bricks, as join_parts of index_fields.cl reads them.
struct Chains {
    std::vector<uint32_t> first{0}, entries;
};

/// True if a field is the first in its bracket. It can't be left out then, because later fields are
/// joined to it.
bool opens_bracket(std::span<const PlacedField> fields, size_t i) {
    if (i == 0) return true;
    const std::vector<FieldBracket>&before = fields[i - 1].place.brackets,
          &own = fields[i].place.brackets;
    return own.size() > before.size() || !std::equal(own.begin(), own.end(), before.begin());
}

/// Lists the parts of one object in all bricks in which it has any. All parts have one table of
/// bricks.
void list_chains(std::span<const PlacedField> fields, std::span<const uint32_t> first_of,
                 Chains& chains) {
    std::vector<std::vector<uint32_t>> slots;
    slots.reserve(fields.size());
    for (const PlacedField& field : fields) slots.push_back(field.grid.slots.read());
    for (size_t brick = 0; brick < slots.front().size(); ++brick) {
        const auto is_stored = [&](const auto& of_part) { return of_part[brick] < kBrickInside; };
        if (std::ranges::none_of(slots, is_stored)) continue;
        for (size_t i = 0; i < fields.size(); ++i) {
            const uint32_t slot = slots[i][brick];
            const FieldPlace& place = fields[i].place;
            const bool is_idle = (place.link == FieldLink::minimum && slot == kBrickOutside) ||
                                 (place.link == FieldLink::maximum && slot == kBrickInside);
            if (is_idle && !opens_bracket(fields, i)) continue;
            chains.entries.insert(
                chains.entries.end(),
                {slot < kBrickInside ? first_of[i] + slot : slot, place.path(), place.links()});
        }
        chains.first.push_back(uint32_t(chains.entries.size() / kChainWords));
    }
}

}  // namespace

bool has_parts(const PlacedWorld& world) {
    return !std::ranges::all_of(world.fields, &PlacedField::is_first);
}

uint32_t chain_depth(const PlacedWorld& world) {
    size_t depth = 0;
    for (const PlacedField& field : world.fields)
        depth = std::max(depth, field.place.brackets.size());
    return uint32_t(depth);
}

void join_parts(const Device& device, const Program& program, const PlacedWorld& world,
                const std::vector<uint32_t>& first_of, const Buffer<uint64_t>& masks) {
    const std::span<const PlacedField> fields = world.fields;
    const Buffer<uint64_t> inside = allocate_masks(device, "inside masks", first_of.back());
    Chains chains;
    for (size_t begin = 0, end = 0; begin < fields.size(); begin = end) {
        for (++end; end < fields.size() && !fields[end].is_first;) ++end;
        if (end - begin == 1) continue;
        for (size_t i = begin; i < end; ++i)
            program.kernel("mark_inside")
                .launch(WorkItem::light, fields[i].grid.brick_count, fields[i].grid.brick_count,
                        first_of[i], fields[i].grid.distance, masks, inside);
        list_chains(fields.subspan(begin, end - begin), std::span(first_of).subspan(begin), chains);
    }
    const auto bricks = uint32_t(chains.first.size() - 1);
    program.kernel("join_parts")
        .launch(WorkItem::light, bricks, bricks,
                Buffer<uint32_t>(device, "chain starts", chains.first),
                Buffer<uint32_t>(device, "chains", chains.entries), inside, masks);
}

}  // namespace voxelume
