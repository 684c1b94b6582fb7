// SPDX-License-Identifier: Apache-2.0
// The parts of solids that keep their own distances.
#include "runtime/geometry/solid/solid_parts.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <string>
#include <vector>

namespace voxelume {
namespace {

Solid ball_at(double x) {
    Solid solid;
    solid.radius = 1;
    solid.parent_from_solid = glm::translate(glm::dmat4(1), {x, 0, 0});
    return solid;
}

Solid box_at(const glm::dvec3& middle, const glm::dvec3& size) {
    Solid solid;
    solid.kind = SolidKind::box;
    solid.size = size;
    solid.parent_from_solid = glm::translate(glm::dmat4(1), middle);
    return solid;
}

Solid joined(SolidKind kind, std::vector<Solid> parts, double x = 0) {
    Solid solid;
    solid.kind = kind;
    solid.parts = std::move(parts);
    solid.parent_from_solid = glm::translate(glm::dmat4(1), {x, 0, 0});
    return solid;
}

/// The formula of parts: their numbers, with - for complements.
std::string formula_of(const std::vector<SolidPart>& parts) {
    std::string text;
    std::vector<uint32_t> open;
    for (size_t i = 0; i < parts.size(); ++i) {
        const auto& [link, brackets] = parts[i].place;
        size_t shared = 0;
        while (shared < std::min(open.size(), brackets.size()) &&
               open[shared] == brackets[shared].number)
            ++shared;
        text.append(open.size() - shared, ')');
        open.resize(shared);
        const FieldLink outer = shared < brackets.size() ? brackets[shared].link : link;
        if (i > 0) text += outer == FieldLink::minimum ? " | " : " & ";
        for (size_t k = shared; k < brackets.size(); ++k) {
            text += '(';
            open.push_back(brackets[k].number);
        }
        text += fmt::format("{}{}", parts[i].is_complement ? "-" : "", i);
    }
    return text.append(open.size(), ')');
}

TEST(SolidParts, OfAShapeAreTheShape) {
    const std::vector<SolidPart> parts = parts_of(ball_at(3));
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].solid, ball_at(3));
}

TEST(SolidParts, OfUnionsOfUnionsAreTheirShapesInPlace) {
    const std::vector<SolidPart> parts = parts_of(
        joined(SolidKind::union_of,
               {ball_at(0), joined(SolidKind::union_of, {ball_at(1), ball_at(2)}, 10)}, 100));
    EXPECT_EQ(formula_of(parts), "0 | 1 | 2");
    EXPECT_EQ(parts[0].solid.parent_from_solid[3].x, 100);
    EXPECT_EQ(parts[1].solid.parent_from_solid[3].x, 111);
    EXPECT_EQ(parts[2].solid.parent_from_solid[3].x, 112);
}

/// A part that fills a hole must not move before the part that cuts the hole.
TEST(SolidParts, WithFacesInOnePlaneStayBehindACut) {
    const Solid wall = joined(SolidKind::union_of, {ball_at(9), box_at({0, 0, 0}, {2, 2, 1})});
    const Solid cut = joined(SolidKind::difference_of, {wall, box_at({1, 0, 0}, {1, 1, 3})});
    const std::vector<SolidPart> parts =
        parts_of(joined(SolidKind::union_of, {cut, box_at({1, 0, 0}, {0.5, 0.5, 1})}));
    EXPECT_EQ(formula_of(parts), "0 | 1 & -2 | 3");
}

TEST(SolidParts, OfADifferenceOfAUnionAreComplements) {
    const std::vector<SolidPart> parts =
        parts_of(joined(SolidKind::difference_of,
                        {ball_at(0), joined(SolidKind::union_of, {ball_at(1), ball_at(2)})}));
    EXPECT_EQ(formula_of(parts), "0 & -1 & -2");
}

Solid bitten(double x) {
    return joined(SolidKind::difference_of, {ball_at(x), ball_at(x + 1)});
}

TEST(SolidParts, OfSeveralDifferencesInAUnionStandInBrackets) {
    const std::vector<SolidPart> parts =
        parts_of(joined(SolidKind::union_of, {ball_at(9), bitten(0), bitten(5)}));
    EXPECT_EQ(formula_of(parts), "0 & -1 | 2 | (3 & -4)");
    EXPECT_EQ(parts[0].solid, ball_at(0));
    EXPECT_EQ(parts[2].solid, ball_at(9));
    EXPECT_EQ(parts[3].solid, ball_at(5));
    EXPECT_EQ(parts[4].solid, ball_at(6));
}

TEST(SolidParts, OfWhatIsTakenFromADifferenceStandInBrackets) {
    EXPECT_EQ(formula_of(parts_of(
                  joined(SolidKind::difference_of, {bitten(0), bitten(3), ball_at(9), bitten(6)}))),
              "-0 | 1 & 2 & -3 & -4 & (-5 | 6)");
}

/// A union of differences, or a difference of unions, ... of balls: 2^levels.
Solid alternating(int levels, double x = 0) {
    if (levels == 0) return ball_at(x);
    const double shift = std::ldexp(1, levels - 1);
    return joined(levels % 2 == 0 ? SolidKind::union_of : SolidKind::intersection_of,
                  {alternating(levels - 1, x), alternating(levels - 1, x + shift)});
}

TEST(SolidParts, StandInThreeBracketsAtMost) {
    EXPECT_EQ(formula_of(parts_of(alternating(2))), "0 & 1 | (2 & 3)");
    EXPECT_EQ(formula_of(parts_of(alternating(3))), "0 & 1 | (2 & 3) & (4 & 5 | (6 & 7))");
    EXPECT_EQ(parts_of(alternating(4)).size(), 16u);
    const std::vector<SolidPart> parts = parts_of(alternating(5));
    EXPECT_EQ(parts.size(), 31u) << "one pair is left whole";
    EXPECT_TRUE(parts.back().is_undivided);
    EXPECT_EQ(count_undivided(alternating(5)), 1u);
    EXPECT_EQ(count_undivided(alternating(4)), 0u);
}

TEST(SolidParts, WithFacesInOnePlaneAreOnePart) {
    const Solid left = box_at({0, 0, 0}, {2, 2, 2}), right = box_at({1.5, 0.1, 0.1}, {2, 1.6, 1.8});
    EXPECT_EQ(parts_of(joined(SolidKind::union_of, {left, right})).size(), 1u)
        << "their faces at z = 1 are one";
    EXPECT_EQ(parts_of(joined(SolidKind::union_of, {left, box_at({1.5, 0.1, 0.2}, {2, 1.6, 1.8})}))
                  .size(),
              2u);
    EXPECT_EQ(parts_of(joined(SolidKind::union_of, {left, box_at({3.5, 0.2, 0.1}, {2, 1.6, 1.8})}))
                  .size(),
              2u)
        << "they lie apart";
    EXPECT_EQ(
        formula_of(parts_of(joined(SolidKind::union_of,
                                   {joined(SolidKind::intersection_of, {ball_at(0), ball_at(1)}),
                                    joined(SolidKind::difference_of, {ball_at(0), left, right})}))),
        "0 & 1 | (2 & -3)")
        << "they are taken away together";
    EXPECT_EQ(parts_of(joined(SolidKind::union_of, {left, ball_at(1), right})).size(), 2u);
}

}  // namespace
}  // namespace voxelume
