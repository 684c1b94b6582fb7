// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/display_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace voxelume {
namespace {

constexpr double kSlack = 1e-9;

Display display_of(DisplayShape shape, double half_angle) {
    Display display;
    display.shape = shape;
    display.half_angles = glm::dvec2(half_angle);
    display.half_size = {1, 0.5};
    display.near = shape == DisplayShape::ball ? 0 : 0.5;
    display.far = 3;
    return display;
}

void expect_enclosed(const Display& display, const glm::dvec3& p) {
    const DisplayShapeRow& row = shape_row(display);
    const Bounds bounds = row.bounds(display);
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(p, bounds.min - kSlack)));
    EXPECT_TRUE(glm::all(glm::lessThanEqual(p, bounds.max + kSlack)));
    const auto sides = row.flat_sides(display);
    if (!sides) {
        EXPECT_LE(glm::length(p), display.far + kSlack);
        return;
    }
    const double by = row.projection == SightProjection::parallel ? 1 : p.z;
    EXPECT_LE(std::abs(p.x), sides->half.x * by + kSlack);
    EXPECT_LE(std::abs(p.y), sides->half.y * by + kSlack);
    EXPECT_GE(p.z, sides->near - kSlack);
}

/// Points of all sight rays of a display, at its near and far surface and between them.
void expect_rays_enclosed(const Display& display) {
    const DisplayShapeRow& row = shape_row(display);
    for (int index = 0; index < 81; ++index) {
        const glm::dvec2 uv(index % 9 / 4.0 - 1, index / 9 / 4.0 - 1);
        if (row.image_is_round && glm::length(uv) > 1) continue;
        for (const double depth : {display.near, 1.7, display.far}) {
            const glm::dvec3 p = row.point_on_ray(display, uv, depth);
            SCOPED_TRACE(testing::Message() << row.name << " at " << uv.x << ' ' << uv.y);
            EXPECT_NEAR(row.depth_is_along_z ? p.z : glm::length(p), depth, kSlack);
            expect_enclosed(display, p);
            if (depth == display.near) {
                EXPECT_LE(glm::length(p), row.start_radius(display) + kSlack);
            }
        }
    }
}

TEST(DisplayShapes, EncloseAllPointsOfTheirSightRays) {
    for (const DisplayShapeRow& row : display_shapes())
        expect_rays_enclosed(display_of(row.shape, 0.6));
}

TEST(DisplayShapes, EncloseTheRaysOfSectorsThatLookBackward) {
    for (const double half_angle : {1.2, 1.5, 2.0, 3.1})
        expect_rays_enclosed(display_of(DisplayShape::sector, half_angle));
}

TEST(DisplayShapes, HaveNumbersOfTheirOwnInKernels) {
    for (const DisplayShapeRow& a : display_shapes())
        for (const DisplayShapeRow& b : display_shapes())
            EXPECT_EQ(a.kernel_number == b.kernel_number, a.shape == b.shape);
}

}  // namespace
}  // namespace voxelume
