// SPDX-License-Identifier: Apache-2.0
// solid -> the unions and intersections that it is made of, without differences.
#pragma once

#include <vector>

#include "runtime/grid/field_place.hpp"
#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// A shape, or the union (FieldLink::minimum) or intersection (FieldLink::maximum) of several
/// terms.
struct SolidTerm {
    Solid whole;                 ///< in the space of the solid's parent
    bool is_complement = false;  ///< the term is all that lies outside of `whole`
    FieldLink link = FieldLink::none;
    std::vector<SolidTerm> terms;  ///< none of them has the same link

    bool is_shape() const { return terms.empty(); }
};

/// A solid's terms, by De Morgan's laws. Shapes of a union that have faces in one plane where they
/// meet are one term: such a face has no edge where one of the shapes ends, but the shapes' own
/// edges, which fields round, would show there. Shapes that are taken away together are joined
/// likewise.
SolidTerm formula_of(const Solid& solid);

}  // namespace voxelume
