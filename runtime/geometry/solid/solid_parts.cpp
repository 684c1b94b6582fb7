// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/solid/solid_parts.hpp"

#include <algorithm>
#include <utility>

#include "runtime/geometry/solid/solid_formula.hpp"

namespace voxelume {
namespace {

/// The number of nested brackets that a term needs when it is written without any around itself.
size_t depth_of(const SolidTerm& term) {
    size_t deepest = 0, second = 0;  // depths of inner terms, with brackets around them
    for (const SolidTerm& inner : term.terms) {
        if (inner.is_shape()) continue;
        const size_t depth = depth_of(inner) + 1;
        second = std::max(second, std::min(deepest, depth));
        deepest = std::max(deepest, depth);
    }
    return std::max(deepest, second + 1) - 1;  // the deepest is written first, without brackets
}

class PartWriter {
  public:
    std::vector<SolidPart> parts;

    /// Writes a term whose first part is joined by `link`, inside of the brackets that are open.
    void write(const SolidTerm& term, FieldLink link) {
        if (term.is_shape())
            write_whole(term, link);
        else
            write_from(term, first_of(term), link);
    }

    /// Writes a term that isn't a shape, its inner term `first` before the others.
    void write_from(const SolidTerm& term, size_t first, FieldLink link) {
        write(term.terms[first], link);
        for (size_t i = 0; i < term.terms.size(); ++i)
            if (i != first) write_joined(term.terms[i], term.link);
    }

  private:
    /// The term that is written first and needs no brackets: the deepest.
    static size_t first_of(const SolidTerm& term) {
        const auto deepest = std::ranges::max_element(term.terms, {}, [](const SolidTerm& inner) {
            return inner.is_shape() ? 0 : depth_of(inner) + 1;
        });
        return size_t(deepest - term.terms.begin());
    }

    void write_joined(const SolidTerm& term, FieldLink link) {
        const bool has_room = brackets_.size() < kMaxBracketDepth && count_ < kMaxBrackets;
        if (term.is_shape() || !has_room) {
            write_whole(term, link);
            return;
        }
        brackets_.push_back({++count_, link});
        write(term, FieldLink::none);
        brackets_.pop_back();
    }

    void write_whole(const SolidTerm& term, FieldLink link) {
        parts.push_back({term.whole, term.is_complement, {link, brackets_}, !term.is_shape()});
    }

    std::vector<FieldBracket> brackets_;
    uint32_t count_ = 0;
};

}  // namespace

std::vector<SolidPart> parts_of(const Solid& solid) {
    PartWriter writer;
    writer.write(formula_of(solid), FieldLink::none);
    return std::move(writer.parts);
}

std::vector<SolidPart> parts_behind_first(const Solid& difference) {
    PartWriter writer;
    const SolidTerm formula = formula_of(difference);
    if (formula.is_shape())
        writer.write(formula, FieldLink::none);
    else
        writer.write_from(formula, 0, FieldLink::none);
    return std::move(writer.parts);
}

size_t count_undivided(const Solid& solid) {
    return size_t(std::ranges::count_if(parts_of(solid), &SolidPart::is_undivided));
}

size_t count_undivided(const std::vector<Solid>& cuts) {
    Solid rest;
    rest.kind = SolidKind::difference_of;
    rest.parts.emplace_back().kind = SolidKind::box;
    rest.parts.insert(rest.parts.end(), cuts.begin(), cuts.end());
    return size_t(std::ranges::count_if(parts_behind_first(rest), &SolidPart::is_undivided));
}

uint32_t count_shapes(const Solid& solid) {
    if (!is_combination(solid.kind)) return 1;
    uint32_t count = 0;
    for (const Solid& part : solid.parts) count += count_shapes(part);
    return count;
}

}  // namespace voxelume
