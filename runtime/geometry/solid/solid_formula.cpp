// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/solid/solid_formula.hpp"

#include <iterator>
#include <utility>

#include "runtime/geometry/solid/flush_faces.hpp"

namespace voxelume {
namespace {

Solid union_of(Solid a, Solid b) {
    Solid both;
    both.kind = SolidKind::union_of;
    both.parts = {std::move(a), std::move(b)};
    return both;
}

/// Joins those of a term's shapes that have faces in one plane.
void join_flush_shapes(SolidTerm& term) {
    // The points outside of several shapes at once are those outside of their union.
    const bool of_complements = term.link == FieldLink::maximum;
    const auto is_open = [&](const SolidTerm& inner) {
        return inner.is_shape() && inner.is_complement == of_complements;
    };
    std::vector<SolidTerm>& terms = term.terms;
    for (size_t i = 0; i < terms.size(); ++i)
        for (size_t j = i + 1; j < terms.size();) {
            if (!is_open(terms[i]) || !is_open(terms[j]) ||
                !have_flush_faces(terms[i].whole, terms[j].whole)) {
                ++j;
                continue;
            }
            terms[i].whole = union_of(std::move(terms[i].whole), std::move(terms[j].whole));
            terms.erase(terms.begin() + std::ptrdiff_t(j));
            j = i + 1;  // a joined shape may continue others
        }
}

SolidTerm term_of(const Solid& solid, const glm::dmat4& frame_from_parent, bool is_complement) {
    const glm::dmat4 map = frame_from_parent * solid.parent_from_solid;
    SolidTerm term;
    term.whole = solid;
    term.is_complement = is_complement;
    term.whole.parent_from_solid = map;
    if (!is_combination(solid.kind)) return term;
    const bool is_union = (solid.kind == SolidKind::union_of) != is_complement;
    term.link = is_union ? FieldLink::minimum : FieldLink::maximum;
    for (size_t i = 0; i < solid.parts.size(); ++i) {
        const bool is_taken_away = solid.kind == SolidKind::difference_of && i > 0;
        SolidTerm inner = term_of(solid.parts[i], map, is_complement != is_taken_away);
        if (inner.link == term.link)
            std::ranges::move(inner.terms, std::back_inserter(term.terms));
        else
            term.terms.push_back(std::move(inner));
    }
    join_flush_shapes(term);
    if (term.terms.size() > 1) return term;
    SolidTerm only = std::move(term.terms.front());
    return only;
}

}  // namespace

SolidTerm formula_of(const Solid& solid) {
    return term_of(solid, glm::dmat4(1), false);
}

}  // namespace voxelume
