// SPDX-License-Identifier: Apache-2.0
// solid -> the parts whose surfaces keep their own distances, so that edges between them are sharp.
#pragma once

#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// A part of a solid, in the space of the solid's parent.
struct SolidPart {
    Solid solid;
    bool is_complement = false;  ///< the part is all that lies outside of `solid`
    FieldLink link = FieldLink::none;
};

/// The parts that make up a solid when each is joined to those before it: all shapes of a tree
/// without brackets, such as unions of unions, or a shape without others. Where several parts of a
/// union are differences or intersections themselves (or the other way round), one of them is
/// divided, and the others stay whole. Parts of a union that have faces in one plane where they
/// meet are one part.
std::vector<SolidPart> parts_of(const Solid& solid);

/// The nodes of a solid's tree.
uint32_t count_nodes(const Solid& solid);

}  // namespace voxelume
