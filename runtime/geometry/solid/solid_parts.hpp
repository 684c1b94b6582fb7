// SPDX-License-Identifier: Apache-2.0
// solid -> the parts whose surfaces keep their own distances, so that edges between them are sharp.
#pragma once

#include <vector>

#include "runtime/grid/field_place.hpp"
#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// A part of a solid, in the space of the solid's parent.
struct SolidPart {
    Solid solid;
    bool is_complement = false;  ///< the part is all that lies outside of `solid`
    FieldPlace place;            ///< in the formula of the parts
    bool is_undivided = false;   ///< `solid` is a combination whose brackets were too many
};

/// The parts that make up a solid when they are joined by their places: all shapes of its tree. A
/// combination that would need more brackets than kMaxBracketDepth and kMaxBrackets stays whole,
/// which takes a tree of at least 32 shapes. Shapes of a union that have faces in one plane where
/// they meet are one part.
std::vector<SolidPart> parts_of(const Solid& solid);

/// The parts of a difference whose first part is a shape: that shape comes first.
std::vector<SolidPart> parts_behind_first(const Solid& difference);

/// The number of combinations in a solid that stay whole, so that edges within them are rounded.
size_t count_undivided(const Solid& solid);
/// Counts the same for solids that are taken away from a mesh, which comes first in the formula.
size_t count_undivided(const std::vector<Solid>& cuts);

/// The number of shapes of which a solid consists.
uint32_t count_shapes(const Solid& solid);

}  // namespace voxelume
