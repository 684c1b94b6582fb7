// SPDX-License-Identifier: Apache-2.0
// Solids' voxels and exact sides against the signs of polynomials in rational numbers, at places on
// the boundary, too: S8 and S9 of tests/CASES.md.
#include <gtest/gtest.h>

#include <random>

#include "runtime/geometry/solid/solid_membership.hpp"
#include "runtime/stages/voxelize/voxelize_solid.hpp"
#include "runtime/verify/exact/occupancy.hpp"
#include "tests/oracles/rational_solid.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/support/solid_cases.hpp"

namespace voxelume {
namespace {

using glm::dvec3;

constexpr uint64_t kRationalSeed = 20261122;

TEST(RationalSolid, SidesAreThoseWorkedOutByHand) {
    Solid torus, cone, ellipsoid, capsule;
    torus.kind = SolidKind::torus, torus.radius = 3, torus.tube = 1;
    cone.kind = SolidKind::cone, cone.radius = 3, cone.top_radius = 1, cone.height = 4;
    ellipsoid.kind = SolidKind::ellipsoid, ellipsoid.radii = {3, 5, 7};
    capsule.kind = SolidKind::capsule, capsule.radius = 2, capsule.height = 6;
    // The map takes (x, y, z) to (2y + 7, x, z): what was along Y lies along X, twice as long.
    const oracle::RationalMap map =
        oracle::rational_map(glm::dmat4({0, 1, 0, 0}, {2, 0, 0, 0}, {0, 0, 1, 0}, {7, 0, 0, 1}));
    const struct {
        const Solid& solid;
        dvec3 point;
        int side;
    } cases[] = {
        {torus, {7, 2, 0}, 0},          {torus, {9, 0, 3}, 0},         {torus, {8.5, 0, 3}, -1},
        {torus, {7, 0, 0}, 1},          {cone, {11, 0, 1}, 0},         {cone, {3, 0, -3}, 0},
        {cone, {7, 2, 0}, 0},           {cone, {7, 1.9, 0}, -1},       {cone, {11.5, 0, 0}, 1},
        {ellipsoid, {17, 0, 0}, 0},     {ellipsoid, {7, 3, 0}, 0},     {ellipsoid, {7, 0, 7}, 0},
        {ellipsoid, {7, 0, -6.99}, -1}, {capsule, {17, 0, 0}, 0},      {capsule, {13, 0, 2}, 0},
        {capsule, {16, 1, 0}, -1},      {capsule, {16.5, 1.6, 1.4}, 1}};
    for (const auto& c : cases)
        EXPECT_EQ(oracle::RationalSolid(c.solid, map).side(c.point), c.side)
            << int(c.solid.kind) << " at " << c.point.x << ' ' << c.point.y << ' ' << c.point.z;
}

TEST(RationalSolid, ATurnHasAnInverseWithoutRounding) {
    const oracle::RationalMap turn = oracle::rational_turn(1, 2, 3, 4);
    const oracle::RationalMap same = oracle::inverse(turn) * turn;
    for (size_t row = 0; row < 3; ++row)
        for (size_t column = 0; column < 3; ++column) {
            EXPECT_EQ(same.linear[row][column], row == column ? 1 : 0);
            EXPECT_EQ(oracle::inverse(turn).linear[row][column], turn.linear[column][row]);
        }
}

/// The number of voxels whose centres are inside by the set SOLID, and of those that differ from
/// the oracle.
struct Compared {
    size_t inside = 0, different = 0;
};

Compared compare_solid(const Solid& solid, const glm::dmat4& rounded_map,
                       const oracle::RationalMap& map, const GridFrame& frame) {
    VoxelizeOptions options;
    options.surface = Surface::cubes;
    options.set = VoxelSet::solid;
    const ReadOccupancy voxels(voxelize_solid(shared_device(), solid, rounded_map, frame, options));
    const oracle::RationalSolid exact(solid, map);
    Compared counts;
    for (glm::ivec3 v{0}; v.z < frame.size.z; ++v.z)
        for (v.y = 0; v.y < frame.size.y; ++v.y)
            for (v.x = 0; v.x < frame.size.x; ++v.x) {
                const dvec3 centre = frame.origin + frame.voxel_edge * (dvec3(v) + 0.5);
                const bool inside = exact.side(centre) <= 0;
                counts.inside += inside;
                counts.different += voxels.is_set(v) != inside;
            }
    return counts;
}

TEST(RationalSolid, S8VoxelsOfTurnedSolidsAreExact) {
    GridFrame frame;  // 128 voxels along the longest side
    frame.origin = {-15.875, -14.75, -13.5};
    frame.voxel_edge = {0.25, 0.3125, 0.375};
    frame.size = {128, 97, 75};
    for (SolidCase& c : shape_cases()) {
        if (c.solid.kind == SolidKind::slab) continue;
        const glm::dmat4 offset = moved(glm::dmat4(1), {0.25, -0.75, 1.125});
        c.solid.parent_from_solid = glm::dmat4(1);
        const Compared counts =
            compare_solid(c.solid, offset * rational_rotation(1, 2, 3, 4),
                          oracle::rational_map(offset) * oracle::rational_turn(1, 2, 3, 4), frame);
        EXPECT_EQ(counts.different, 0u) << c.name;
        EXPECT_GT(counts.inside, 5000u) << c.name;
    }
}

/// Random solids of small integers, so that places of the lattice often lie on boundaries.
class TouchingSolids {
  public:
    explicit TouchingSolids(uint64_t seed) : random_(seed) {}

    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

    Solid shape() {
        Solid s;
        s.kind = SolidKind(whole(0, 7));
        s.radius = whole(1, 7), s.top_radius = whole(0, 5), s.height = 2 * whole(1, 5);
        s.tube = whole(1, int(s.radius)), s.thickness = whole(1, 6);
        s.radii = {whole(1, 7), whole(1, 7), whole(1, 7)};
        s.size = {whole(1, 12), whole(1, 12), whole(1, 12)};
        return s;
    }
    Solid solid() {
        if (whole(0, 2) != 0) return shape();
        std::vector<Solid> parts = {shape(), shape(), shape()};
        for (Solid& part : parts) part.parent_from_solid = moved(glm::dmat4(1), point(4));
        return combined(SolidKind(8 + whole(0, 2)), parts);
    }
    /// A map whose entries and inverse are exact doubles: quarter turns, shears by whole numbers,
    /// powers of two.
    glm::dmat4 map() {
        glm::dmat4 m(1);
        for (int i = whole(0, 4); i > 0; --i) {
            const int a = whole(0, 2), b = (a + whole(1, 2)) % 3;
            glm::dmat4 step(1);
            switch (whole(0, 2)) {
                case 0:
                    step[a][b] = whole(-2, 2);
                    break;
                case 1:
                    step[a][a] = whole(0, 1) ? 2 : 0.5;
                    break;
                default:
                    step[a][a] = step[b][b] = 0, step[a][b] = 1, step[b][a] = -1;
            }
            m = step * m;
        }
        return moved(m, point(6) / 2.0);
    }
    dvec3 point(int reach) {
        return {whole(-reach, reach), whole(-reach, reach), whole(-reach, reach)};
    }

  private:
    std::mt19937_64 random_;
};

TEST(RationalSolid, S9SidesOfAMillionPlacesAreExactOnTheBoundaryToo) {
    constexpr int kSolids = 10'000, kPoints = 100;
    TouchingSolids random(kRationalSeed);
    int inside = 0, touching = 0;
    for (int number = 0; number < kSolids; ++number) {
        const Solid solid = random.solid();
        const glm::dmat4 map = random.map();
        GridFrame frame;
        frame.origin = random.point(8) / 2.0;
        frame.voxel_edge = dvec3(random.whole(1, 2), 1, random.whole(1, 4) / 4.0);
        frame.size = glm::ivec3(1 << 10);
        const SolidProgram program = make_solid_program(solid, map, frame);
        const oracle::RationalSolid exact(solid, oracle::rational_map(map));
        for (int i = 0; i < kPoints; ++i) {
            const dvec3 place = dvec3(map * glm::dvec4(random.point(7), 1));
            const glm::ivec3 at(glm::round(2.0 * (place - frame.origin) / frame.voxel_edge));
            const int side = exact.side(frame.origin + frame.voxel_edge * dvec3(at) / 2.0);
            inside += side < 0;
            touching += side == 0;
            ASSERT_EQ(exact_side(program, at), side)
                << "seed " << kRationalSeed << ", solid " << number << ", point " << i;
        }
    }
    EXPECT_GT(inside, kSolids * kPoints / 10);
    EXPECT_GT(touching, kSolids * kPoints / 100);
}

TEST(RationalSolid, S9VoxelsOfSolidsThatTouchCentresAreExact) {
    TouchingSolids random(kRationalSeed + 1);
    size_t inside = 0;
    for (int number = 0; number < 200; ++number) {
        const Solid solid = random.solid();
        const glm::dmat4 map = random.map();
        GridFrame frame;
        frame.voxel_edge = dvec3(1, 1, random.whole(1, 2));
        frame.origin = dvec3(-9.5, -8.5, -10) - frame.voxel_edge / 2.0 * double(random.whole(0, 1));
        frame.size = {19, 18, 17};
        const Compared counts = compare_solid(solid, map, oracle::rational_map(map), frame);
        ASSERT_EQ(counts.different, 0u) << "seed " << kRationalSeed + 1 << ", solid " << number;
        inside += counts.inside;
    }
    EXPECT_GT(inside, 50000u);
}

}  // namespace
}  // namespace voxelume
