// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/solid/solid_parts.hpp"

#include <algorithm>
#include <utility>

#include "runtime/geometry/solid/flush_faces.hpp"

namespace voxelume {
namespace {

using Parts = std::vector<SolidPart>;

SolidPart whole(Solid solid, const glm::dmat4& frame_from_parent, bool is_complement) {
    solid.parent_from_solid = frame_from_parent * solid.parent_from_solid;
    return {std::move(solid), is_complement, FieldLink::none};
}

/// True if the parts may be joined to others by `link` in any order.
bool joins_by(const Parts& parts, FieldLink link) {
    return std::all_of(parts.begin() + 1, parts.end(),
                       [&](const SolidPart& part) { return part.link == link; });
}

Parts divide(const Solid& solid, const glm::dmat4& frame_from_parent, bool is_complement) {
    if (!is_combination(solid.kind)) return {whole(solid, frame_from_parent, is_complement)};
    const glm::dmat4 map = frame_from_parent * solid.parent_from_solid;
    // De Morgan: the complement of a union is the intersection of the complements.
    const bool is_union = (solid.kind == SolidKind::union_of) != is_complement;
    const FieldLink link = is_union ? FieldLink::least : FieldLink::largest;
    Parts first, others;
    for (size_t i = 0; i < solid.parts.size(); ++i) {
        const bool is_taken_away = solid.kind == SolidKind::difference_of && i > 0;
        const bool is_outside = is_complement != is_taken_away;
        Parts divided = divide(solid.parts[i], map, is_outside);
        if (!joins_by(divided, link) && first.empty()) {
            first = std::move(divided);
            continue;
        }
        if (!joins_by(divided, link)) divided = {whole(solid.parts[i], map, is_outside)};
        for (SolidPart& part : divided) part.link = link;
        others.insert(others.end(), divided.begin(), divided.end());
    }
    first.insert(first.end(), others.begin(), others.end());
    first.front().link = FieldLink::none;
    return first;
}

Solid union_of(Solid a, Solid b) {
    Solid both;
    both.kind = SolidKind::union_of;
    both.parts = {std::move(a), std::move(b)};
    return both;
}

/// Makes one part of those of a union whose faces continue each other: such a face has no edge
/// where one of them ends, but their own edges, which fields round, would show there.
Parts with_flush_ones_joined(Parts parts) {
    const bool is_union = joins_by(parts, FieldLink::least);
    const auto is_open = [&](const SolidPart& part) {
        const bool is_in_union =
            part.link == FieldLink::least || (is_union && part.link == FieldLink::none);
        return is_in_union && !part.is_complement;
    };
    for (size_t i = 0; i < parts.size(); ++i)
        for (size_t j = i + 1; j < parts.size();) {
            // A part mustn't move past one that takes something away from those before it.
            if (parts[j].link != FieldLink::least) break;
            if (!is_open(parts[i]) || !is_open(parts[j]) ||
                !have_flush_faces(parts[i].solid, parts[j].solid)) {
                ++j;
                continue;
            }
            parts[i].solid = union_of(std::move(parts[i].solid), std::move(parts[j].solid));
            parts.erase(parts.begin() + std::ptrdiff_t(j));
            j = i + 1;  // what is joined may continue others
        }
    return parts;
}

}  // namespace

std::vector<SolidPart> parts_of(const Solid& solid) {
    return with_flush_ones_joined(divide(solid, glm::dmat4(1), false));
}

uint32_t count_nodes(const Solid& solid) {
    uint32_t count = 1;
    for (const Solid& part : solid.parts) count += count_nodes(part);
    return count;
}

}  // namespace voxelume
