// SPDX-License-Identifier: Apache-2.0
// The boxes around analytic solids, and the lattices that hold them.
#include "runtime/geometry/solid/solid_bounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/error.hpp"
#include "tests/oracles/analytic_solids.hpp"
#include "tests/support/solid_cases.hpp"

namespace voxelume {
namespace {

TEST(SolidBounds, TouchTheShapeOnEverySide) {
    for (const SolidCase& c : shape_cases()) {
        if (c.solid.kind == SolidKind::slab) continue;
        const SolidBounds box = bounds(c.solid, glm::dmat4(1));
        const oracle::AnalyticSolid exact(c.solid, glm::dmat4(1));
        for (int axis = 0; axis < 3; ++axis)
            for (const double face : {box.min[axis], box.max[axis]}) {
                long double nearest = INFINITY;
                for (int i = 0; i < 10000; ++i) {
                    glm::dvec3 p(face);
                    for (int side = 1; side < 3; ++side) {
                        const int a = (axis + side) % 3;
                        p[a] = glm::mix(box.min[a], box.max[a],
                                        (side == 1 ? i % 100 : i / 100) / 99.0);
                    }
                    nearest = std::min(nearest, exact.distance(oracle::Vector(p)));
                }
                EXPECT_GT(nearest, -1e-12) << c.name << " " << axis;
                EXPECT_LT(nearest, 0.2) << c.name << " " << axis;
            }
    }
}

TEST(SolidBounds, ASlabNeedsAClipBoxOnlyWhereItIsInfinite) {
    Solid slab;
    slab.kind = SolidKind::slab, slab.thickness = 3;
    EXPECT_THROW(bounds(slab, glm::dmat4(1)), Error);
    const SolidBounds clip{{-4, -5, -6}, {7, 8, 9}};
    const SolidBounds box = bounds(slab, glm::dmat4(1), clip);
    EXPECT_EQ(box.min, glm::dvec3(-4, -1.5, -6));
    EXPECT_EQ(box.max, glm::dvec3(7, 1.5, 9));
    Solid ball;
    ball.radius = 2;
    const SolidBounds cut =
        bounds(combined(SolidKind::intersection_of, {slab, ball}), glm::dmat4(1));
    EXPECT_EQ(cut.min, glm::dvec3(-2, -1.5, -2));
}

TEST(FrameAround, LeavesTheMarginAndLiesOnTheLattice) {
    Solid ball;
    ball.radius = 2;
    const GridFrame frame = frame_around(ball, moved(glm::dmat4(1), {0.1, 10, -3}), {0.5, 0.25, 1},
                                         4, SolidBounds{{-9, -9, -9}, {9, 9, 9}});
    EXPECT_EQ(frame.origin, glm::dvec3(-4, 7, -9));
    EXPECT_EQ(frame.size, glm::ivec3(17, 8, 12));
    EXPECT_THROW(frame_around(ball, moved(glm::dmat4(1), {0, 20, 0}), {1, 1, 1}, 4,
                              SolidBounds{{-9, -9, -9}, {9, 9, 9}}),
                 Error);
}

}  // namespace
}  // namespace voxelume
