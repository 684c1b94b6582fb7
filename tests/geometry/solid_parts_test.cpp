// SPDX-License-Identifier: Apache-2.0
// Which parts of solids keep distances of their own.
#include "runtime/geometry/solid/solid_parts.hpp"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <vector>

namespace voxelume {
namespace {

Solid ball(double x) {
    Solid solid;
    solid.radius = 1;
    solid.parent_from_solid = glm::translate(glm::dmat4(1), {x, 0, 0});
    return solid;
}

Solid box(const glm::dvec3& middle, const glm::dvec3& size) {
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

std::vector<FieldLink> links_of(const std::vector<SolidPart>& parts) {
    std::vector<FieldLink> links;
    for (const SolidPart& part : parts) links.push_back(part.link);
    return links;
}

constexpr FieldLink kNone = FieldLink::none, kLeast = FieldLink::least,
                    kLargest = FieldLink::largest;

TEST(SolidParts, OfAShapeAreTheShape) {
    const std::vector<SolidPart> parts = parts_of(ball(3));
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].solid, ball(3));
}

TEST(SolidParts, OfUnionsOfUnionsAreTheirShapesInPlace) {
    const std::vector<SolidPart> parts = parts_of(joined(
        SolidKind::union_of, {ball(0), joined(SolidKind::union_of, {ball(1), ball(2)}, 10)}, 100));
    EXPECT_EQ(links_of(parts), (std::vector{kNone, kLeast, kLeast}));
    EXPECT_EQ(parts[0].solid.parent_from_solid[3].x, 100);
    EXPECT_EQ(parts[1].solid.parent_from_solid[3].x, 111);
    EXPECT_EQ(parts[2].solid.parent_from_solid[3].x, 112);
}

/// What fills a hole must not move before the part that cuts it.
TEST(SolidParts, WithFacesInOnePlaneStayBehindACut) {
    const Solid wall = joined(SolidKind::union_of, {ball(9), box({0, 0, 0}, {2, 2, 1})});
    const Solid cut = joined(SolidKind::difference_of, {wall, box({1, 0, 0}, {1, 1, 3})});
    const std::vector<SolidPart> parts =
        parts_of(joined(SolidKind::union_of, {cut, box({1, 0, 0}, {0.5, 0.5, 1})}));
    EXPECT_EQ(links_of(parts), (std::vector{kNone, kLeast, kLargest, kLeast}));
}

TEST(SolidParts, OfADifferenceOfAUnionAreComplements) {
    const std::vector<SolidPart> parts = parts_of(joined(
        SolidKind::difference_of, {ball(0), joined(SolidKind::union_of, {ball(1), ball(2)})}));
    EXPECT_EQ(links_of(parts), (std::vector{kNone, kLargest, kLargest}));
    EXPECT_FALSE(parts[0].is_complement);
    EXPECT_TRUE(parts[1].is_complement);
    EXPECT_TRUE(parts[2].is_complement);
}

TEST(SolidParts, OfOneOfSeveralDifferencesInAUnionAreDivided) {
    const auto bitten = [](double x) {
        return joined(SolidKind::difference_of, {ball(x), ball(x + 1)});
    };
    const std::vector<SolidPart> parts =
        parts_of(joined(SolidKind::union_of, {ball(9), bitten(0), bitten(5)}));
    EXPECT_EQ(links_of(parts), (std::vector{kNone, kLargest, kLeast, kLeast}));
    EXPECT_EQ(parts[0].solid, ball(0));
    EXPECT_TRUE(parts[1].is_complement);
    EXPECT_EQ(parts[2].solid, ball(9));
    EXPECT_EQ(parts[3].solid, bitten(5));
}

TEST(SolidParts, WithFacesInOnePlaneAreOnePart) {
    const Solid left = box({0, 0, 0}, {2, 2, 2}), right = box({1.5, 0.1, 0.1}, {2, 1.6, 1.8});
    EXPECT_EQ(parts_of(joined(SolidKind::union_of, {left, right})).size(), 1u)
        << "their faces at z = 1 are one";
    EXPECT_EQ(
        parts_of(joined(SolidKind::union_of, {left, box({1.5, 0.1, 0.2}, {2, 1.6, 1.8})})).size(),
        2u);
    EXPECT_EQ(
        parts_of(joined(SolidKind::union_of, {left, box({3.5, 0.2, 0.1}, {2, 1.6, 1.8})})).size(),
        2u)
        << "they lie apart";
    EXPECT_EQ(parts_of(joined(SolidKind::union_of, {left, ball(1), right})).size(), 2u);
}

}  // namespace
}  // namespace voxelume
