// SPDX-License-Identifier: Apache-2.0
// The side of a solid that a lattice point is on, in exact arithmetic: random solids, maps and
// points.
#include "runtime/geometry/solid/solid_membership.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime/geometry/solid/solid_program.hpp"
#include "tests/oracles/analytic_solids.hpp"
#include "tests/support/solid_cases.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kMembershipSeed = 20261121;

class RandomSolids {
  public:
    /// A shape of any kind, up to 10 metres large.
    Solid shape() {
        Solid s;
        s.kind = SolidKind(whole(0, 7));
        s.radius = length(), s.top_radius = length(), s.height = length(), s.thickness = length();
        s.tube = s.radius * whole(1, 16) / 16;
        s.radii = {length(), length(), length()};
        s.size = {length(), length(), length()};
        return s;
    }
    /// A rational turn as doubles, stretched unevenly or not, and a shift of up to 4 metres.
    glm::dmat4 map() {
        const glm::dmat4 turn =
            rational_rotation(whole(1, 6), whole(-6, 6), whole(-6, 6), whole(-6, 6));
        const glm::dvec3 by = whole(0, 1) == 0
                                  ? glm::dvec3(1)
                                  : glm::dvec3(whole(4, 31), whole(4, 31), whole(4, 31)) / 16.0;
        return moved(stretched(turn, by), glm::dvec3(point(64)) / 16.0);
    }
    glm::ivec3 point(int reach) {
        return {whole(-reach, reach), whole(-reach, reach), whole(-reach, reach)};
    }
    GridFrame frame() {
        GridFrame frame;
        frame.origin = glm::dvec3(point(160)) / 16.0;
        frame.voxel_edge = glm::dvec3(whole(1, 16), whole(1, 16), whole(1, 16)) / 16.0;
        frame.size = glm::ivec3(1 << 12);
        return frame;
    }
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  private:
    double length() { return whole(1, 160) / 16.0; }
    std::mt19937_64 random_{kMembershipSeed};
};

TEST(SolidMembership, S9OfRandomSolidsUnderRationalMapsIsExact) {
    constexpr int kSolids = 20'000, kPoints = 50;
    RandomSolids random;
    int undecided = 0, inside = 0;
    for (int number = 0; number < kSolids; ++number) {
        const Solid solid = random.shape();
        const glm::dmat4 map = random.map();
        const GridFrame frame = random.frame();
        const SolidProgram program = make_solid_program(solid, map, frame);
        const oracle::AnalyticSolid exact(solid, map);
        for (int i = 0; i < kPoints; ++i) {
            // The place lies around the solid; `at` is in half voxels.
            const glm::dvec3 place = glm::dvec3(map[3]) + glm::dvec3(random.point(192)) / 16.0;
            const glm::ivec3 at =
                glm::ivec3(glm::round(2.0 * (place - frame.origin) / frame.voxel_edge));
            const oracle::Vector point =
                oracle::Vector(frame.origin) +
                oracle::Vector(frame.voxel_edge) * oracle::Vector(at) / (long double)(2);
            const long double distance = exact.distance(point);
            if (std::abs(distance) < 1e-11) {  // where the maps' rounding decides
                ++undecided;
                continue;
            }
            inside += distance < 0;
            ASSERT_EQ(exact_side(program, at), distance > 0 ? 1 : -1)
                << "seed " << kMembershipSeed << ", solid " << number << ", point " << i;
        }
    }
    EXPECT_LT(undecided, kSolids * kPoints / 100);
    EXPECT_GT(inside, kSolids * kPoints / 50);
}

}  // namespace
}  // namespace voxelume
