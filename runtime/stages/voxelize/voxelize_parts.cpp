// SPDX-License-Identifier: Apache-2.0
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "runtime/geometry/solid/solid_parts.hpp"
#include "runtime/stages/voxelize/voxelize_solid.hpp"

namespace voxelume {
namespace {

/// The content of a frame: the result of a bracket of a formula, or of the parts joined so far.
struct JoinedParts {
    std::vector<GridPart> parts;  ///< parts whose surfaces pass the frame
    bool is_full = false;         ///< without parts: the frame is inside; otherwise outside
};

/// Joins parts to those before them, and drops those that decide nothing.
void join(JoinedParts& all, JoinedParts next, FieldLink link) {
    const bool is_union = link == FieldLink::minimum;
    const bool is_idle = all.parts.empty() && all.is_full != is_union;
    const bool decides_all = next.parts.empty() && next.is_full == is_union;
    if (link == FieldLink::none || is_idle || decides_all)
        all = std::move(next);
    else if (!all.parts.empty())
        std::ranges::move(next.parts, std::back_inserter(all.parts));
}

JoinedParts only(GridPart part) {
    if (part.grid->brick_count > 0) return {{std::move(part)}};
    return {{}, part.grid->slots.read_one(0) == kBrickInside};
}

bool is_within(const GridPart& part, size_t depth, uint32_t bracket) {
    const std::vector<FieldBracket>& around = part.place.brackets;
    return depth == 0 || (around.size() >= depth && around[depth - 1].number == bracket);
}

/// Joins the parts in the bracket at `depth` that begins with the first of `left`, and removes them
/// from `left`.
JoinedParts join_bracket(std::span<GridPart>& left, size_t depth) {
    const uint32_t bracket = depth > 0 ? left.front().place.brackets[depth - 1].number : 0;
    JoinedParts all;
    for (bool is_first = true; !left.empty() && is_within(left.front(), depth, bracket);
         is_first = false) {
        const FieldPlace& place = left.front().place;
        const bool is_alone = place.brackets.size() == depth;
        FieldLink link = is_alone ? place.link : place.brackets[depth].link;
        if (is_first) link = FieldLink::none;
        if (is_alone) {
            join(all, only(std::move(left.front())), link);
            left = left.subspan(1);
        } else {
            join(all, join_bracket(left, depth + 1), link);
        }
    }
    return all;
}

}  // namespace

BrickGrid with_parts(std::vector<GridPart> parts) {
    if (parts.empty()) return {};
    std::span<GridPart> left(parts);
    JoinedParts joined = join_bracket(left, 0);
    if (joined.parts.empty()) return {};
    BrickGrid first = *joined.parts.front().grid;
    first.place = std::move(joined.parts.front().place);
    first.parts.assign(std::move_iterator(joined.parts.begin() + 1),
                       std::move_iterator(joined.parts.end()));
    return first;
}

BrickGrid voxelize_parts(const Device& device, const Solid& solid,
                         const glm::dmat4& frame_from_solid, const GridFrame& frame) {
    const std::vector<SolidPart> parts = parts_of(solid);
    std::vector<GridPart> grids;
    for (const SolidPart& part : parts) {
        if (parts.size() == 1) break;
        BrickGrid grid =
            voxelize_part(device, part.solid, part.is_complement, frame_from_solid, frame);
        grids.push_back({std::make_shared<const BrickGrid>(std::move(grid)), part.place});
    }
    BrickGrid joined = with_parts(std::move(grids));
    if (joined.brick_count > 0) return joined;
    return voxelize_solid(device, solid, frame_from_solid, frame, {.surface = Surface::smooth});
}

}  // namespace voxelume
