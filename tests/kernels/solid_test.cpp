// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "runtime/geometry/solid/solid_membership.hpp"
#include "runtime/geometry/solid/solid_program.hpp"
#include "runtime/opencl/program.hpp"
#include "tests/oracles/analytic_solids.hpp"
#include "tests/support/solid_cases.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

struct Distances {
    std::vector<float> distance, rounding;
};

/// Runs solid_distance() with a given number of lanes.
class Measurement {
  public:
    explicit Measurement(int lanes)
        : device_(test_device(lanes)), code_(Program::from_text(device_, R"(
#include "lib/solid/solid.h"
#include "lib/lanes/work_item.h"
kernel void measure(global const SolidShape* solids, global const int* cells,
                    global const float* offsets, uint count, global float* distances) {
    const uint i = work_item() * VXL_LANES;
    if (i >= count) return;
    LatticePoint at;
    at.x = LANES_LOAD(cells, i);
    at.y = LANES_LOAD(cells, count + i);
    at.z = LANES_LOAD(cells, 2u * count + i);
    at.offset_x = LANES_LOAD(offsets, i);
    at.offset_y = LANES_LOAD(offsets, count + i);
    at.offset_z = LANES_LOAD(offsets, 2u * count + i);
    const SolidDistance d = solid_distance(solids, 0, at);
    LANES_STORE(d.distance, distances, i);
    LANES_STORE(d.rounding, distances, count + i);
}
)")) {}

    /// The distances at cells + offsets; their number is a multiple of 16.
    Distances operator()(const SolidProgram& program, const std::vector<glm::ivec3>& cells,
                         const std::vector<glm::vec3>& offsets) const {
        const size_t n = cells.size();
        std::vector<int32_t> cell_columns(3 * n);
        std::vector<float> offset_columns(3 * n);
        for (size_t i = 0; i < n; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                cell_columns[axis * n + i] = cells[i][axis];
                offset_columns[axis * n + i] = offsets[i][axis];
            }
        const Buffer<uint32_t> solids(device_, "solids", program.words());
        const Buffer<int32_t> cell_buffer(device_, "cells", cell_columns);
        const Buffer<float> offset_buffer(device_, "offsets", offset_columns);
        const Buffer<float> distances(device_, "distances", 2 * n);
        code_.kernel("measure").launch(WorkItem::light, n / device_.lanes(), solids, cell_buffer,
                                       offset_buffer, static_cast<uint32_t>(n), distances);
        return {distances.read(0, n), distances.read(n, n)};
    }

  private:
    Device device_;
    Program code_;
};

struct Lattice {
    GridFrame frame;
    std::vector<glm::ivec3> cells;
    std::vector<glm::vec3> offsets;

    oracle::Vector point(size_t i) const {
        return oracle::Vector(frame.origin) +
               oracle::Vector(frame.voxel_edge) *
                   (oracle::Vector(cells[i]) + oracle::Vector(offsets[i]));
    }
    long double shortest_edge() const {
        return std::min({frame.voxel_edge.x, frame.voxel_edge.y, frame.voxel_edge.z});
    }
};

/// Random points around the origin of a frame whose own origin is far from it.
Lattice random_lattice(unsigned seed, size_t count) {
    Lattice lattice;
    lattice.frame.origin = {-1000.25, -700.5, -300.125};
    lattice.frame.voxel_edge = {0.5, 0.75, 0.375};
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3 metres(40 * unit(random) - 20, 40 * unit(random) - 20,
                                40 * unit(random) - 20);
        lattice.cells.emplace_back((metres - lattice.frame.origin) / lattice.frame.voxel_edge);
        lattice.offsets.emplace_back(unit(random), unit(random), unit(random));
    }
    return lattice;
}

TEST(SolidProgram, ADifferenceBecomesAnIntersectionWithComplements) {
    Solid box, bore, ball;
    box.kind = SolidKind::box, box.size = {2, 4, 6};
    bore.kind = SolidKind::cylinder, bore.radius = 0.5, bore.height = 5;
    ball.radius = 0.25;
    const Solid solid =
        combined(SolidKind::difference_of, {box, combined(SolidKind::union_of, {bore, ball})});
    const SolidProgram program = make_solid_program(solid, glm::dmat4(1), GridFrame{});
    ASSERT_EQ(program.shapes.size(), 3u);
    EXPECT_EQ(program.shapes[0].kind, VXL_SOLID_BOX);
    EXPECT_EQ(program.shapes[0].shape_count, 3u);
    EXPECT_EQ(program.shapes[0].operations, 0u);
    EXPECT_EQ(program.shapes[1].kind, VXL_SOLID_CYLINDER | VXL_SOLID_COMPLEMENT);
    EXPECT_EQ(program.shapes[1].operations, 0u);
    EXPECT_EQ(program.shapes[2].kind, VXL_SOLID_SPHERE | VXL_SOLID_COMPLEMENT);
    EXPECT_EQ(program.shapes[2].operations, VXL_SOLID_INTERSECTION | VXL_SOLID_INTERSECTION << 2);
    EXPECT_EQ(program.shapes[0].size[1], 2.0f);
    EXPECT_EQ(program.shapes[1].size[1], 2.5f);
}

TEST(SolidProgram, AScaledBallIsAnEllipsoidAndAScaledBackOneABall) {
    Solid ball;
    ball.radius = 2;
    ball.parent_from_solid = stretched(glm::dmat4(1), {1, 3, 0.5});
    SolidProgram program = make_solid_program(ball, glm::dmat4(1), GridFrame{});
    EXPECT_EQ(program.shapes[0].kind, VXL_SOLID_ELLIPSOID);
    EXPECT_EQ(program.shapes[0].size[1], 6.0f);
    ball.kind = SolidKind::ellipsoid, ball.radii = {6, 2, 12};
    program = make_solid_program(ball, glm::dmat4(1), GridFrame{});
    EXPECT_EQ(program.shapes[0].kind, VXL_SOLID_SPHERE);
    EXPECT_FLOAT_EQ(program.shapes[0].size[0], 6.0f);
}

TEST(SolidShape, EveryFieldIsReadWhereTheHostWroteIt) {
    static_assert(sizeof(SolidShape) == 128);
    SolidShape shape{};
    std::vector<uint32_t> words(VXL_SOLID_WORDS);
    for (uint32_t i = 0; i < words.size(); ++i) words[i] = 0x40000000u + i;
    std::memcpy(&shape, words.data(), sizeof(shape));
    const Device device = test_device();
    const Program code = Program::from_text(device, R"(
#include "lib/lanes/lanes.h"
#include "shared/solid.h"
kernel void copy_fields(global const SolidShape* s, global uint* out) {
    out[0] = s->kind, out[1] = s->operations, out[2] = s->shape_count, out[3] = s->attribute;
    for (int i = 0; i < 3; ++i) out[4 + i] = (uint)s->cell[i], out[7 + i] = as_uint(s->fraction[i]);
    for (int i = 0; i < 9; ++i) out[10 + i] = as_uint(s->shape_from_grid[i]);
    for (int i = 0; i < 4; ++i) out[19 + i] = as_uint(s->size[i]);
    for (int i = 0; i < 2; ++i) out[23 + i] = as_uint(s->rounding[i]);
    for (int i = 0; i < 5; ++i) out[25 + i] = as_uint(s->derived[i]);
    out[30] = as_uint(s->reach);
    out[31] = as_uint(s->unused);
}
)");
    const Buffer<uint32_t> in(device, "in", words), out(device, "out", words.size());
    code.kernel("copy_fields").launch(WorkItem::heavy, 1, in, out);
    EXPECT_EQ(out.read(), words);
    EXPECT_EQ(shape.size[2], std::bit_cast<float>(words[21]));
    EXPECT_EQ(shape.derived[3], std::bit_cast<float>(words[28]));
}

/// Compares a case's distances with the oracle. Where they are exact, they are within the stated
/// rounding; elsewhere they have the right sign and don't exceed the Euclidean distance.
void expect_oracle_distances(const SolidCase& c, const glm::dmat4& frame_from_solid,
                             unsigned seed) {
    static const Measurement measure(0);
    const Lattice lattice = random_lattice(seed, 4096);
    const SolidProgram program = make_solid_program(c.solid, frame_from_solid, lattice.frame);
    const oracle::AnalyticSolid exact(c.solid, frame_from_solid);
    const Distances measured = measure(program, lattice.cells, lattice.offsets);
    for (size_t i = 0; i < lattice.cells.size(); ++i) {
        const auto truth =
            static_cast<double>(exact.distance(lattice.point(i)) / lattice.shortest_edge());
        ASSERT_NEAR(measured.distance[i], truth, measured.rounding[i])
            << c.name << ", seed " << seed << ", point " << i;
        ASSERT_LT(measured.rounding[i], 1e-3f) << c.name;
    }
}

TEST(SolidDistance, EveryKindIsRightWithinItsRounding) {
    for (const SolidCase& c : shape_cases()) expect_oracle_distances(c, glm::dmat4(1), 11);
}

TEST(SolidDistance, CombinationsAreRightWithinTheirRounding) {
    for (const SolidCase& c : combination_cases())
        expect_oracle_distances(c, rational_rotation(1, 3, 0, 2), 12);
}

TEST(SolidDistance, ShearedShapesAreScaledByTheSmallestStretch) {
    glm::dmat4 shear(1);
    shear[1] = {0.7, 1.2, -0.3, 0};
    for (const SolidCase& c : shape_cases()) {
        // The images of these solids have the same kind and their own exact distance.
        if (c.solid.kind == SolidKind::sphere || c.solid.kind == SolidKind::ellipsoid ||
            c.solid.kind == SolidKind::slab)
            continue;
        expect_oracle_distances(c, shear, 13);
    }
}

TEST(SolidDistance, AShearedEllipsoidHasItsTrueDistance) {
    Solid ball;
    ball.radius = 7;
    glm::dmat4 shear(1);
    shear[1] = {0.6, 1, 0, 0};
    const Lattice lattice = random_lattice(14, 1024);
    const Distances d = Measurement(0)(make_solid_program(ball, shear, lattice.frame),
                                       lattice.cells, lattice.offsets);
    // The oracle is the nearest of many points of the sheared ball.
    for (size_t i = 0; i < 40; ++i) {
        const oracle::Vector at = lattice.point(i);
        double nearest = INFINITY;
        for (int u = 0; u < 720; ++u)
            for (int v = 0; v < 360; ++v) {
                const double a = u * M_PI / 360, b = v * M_PI / 360;
                const glm::dvec4 p =
                    shear * glm::dvec4(7 * std::sin(b) * std::cos(a), 7 * std::cos(b),
                                       7 * std::sin(b) * std::sin(a), 1);
                nearest = std::min(nearest, glm::distance(glm::dvec3(p), glm::dvec3(at)));
            }
        EXPECT_NEAR(std::abs(d.distance[i]) * 0.375, nearest, 0.06) << i;
    }
}

TEST(SolidDistance, HasTheSameBitsForAnyNumberOfLanes) {
    const Lattice lattice = random_lattice(15, 2048);
    std::vector<SolidCase> cases = shape_cases();
    for (const SolidCase& c : combination_cases()) cases.push_back(c);
    std::vector<std::vector<float>> expected;
    for (const int lanes : lanes_to_compare(1)) {
        const Measurement measure(lanes);
        for (size_t i = 0; i < cases.size(); ++i) {
            const SolidProgram program =
                make_solid_program(cases[i].solid, glm::dmat4(1), lattice.frame);
            const Distances d = measure(program, lattice.cells, lattice.offsets);
            if (lanes == 1) expected.push_back(d.distance);
            ASSERT_EQ(0, std::memcmp(expected[i].data(), d.distance.data(), 4 * 2048))
                << cases[i].name << " with " << lanes << " lanes";
        }
    }
}

TEST(ExactSide, AgreesWithTheOracleAwayFromTheSurface) {
    std::vector<SolidCase> cases = shape_cases();
    for (const SolidCase& c : combination_cases()) cases.push_back(c);
    const Lattice lattice = random_lattice(16, 2000);
    for (const SolidCase& c : cases) {
        const SolidProgram program = make_solid_program(c.solid, glm::dmat4(1), lattice.frame);
        const oracle::AnalyticSolid exact(c.solid, glm::dmat4(1));
        for (const glm::ivec3& cell : lattice.cells) {
            const oracle::Vector point =
                oracle::Vector(lattice.frame.origin) +
                oracle::Vector(lattice.frame.voxel_edge) * oracle::Vector(cell);
            const long double distance = exact.distance(point);
            if (std::abs(distance) < 1e-12)
                continue;  // the double maps differ from the decimal ones
            ASSERT_EQ(exact_side(program, 2 * cell), distance > 0 ? 1 : -1) << c.name;
        }
    }
}

TEST(ExactSide, FindsBoundaryPointsOfEveryKind) {
    Solid s;
    s.radius = 5, s.top_radius = 2, s.height = 6, s.tube = 1, s.thickness = 4;
    s.radii = {3, 5, 4}, s.size = {4, 6, 2};
    const struct {
        SolidKind kind;
        glm::ivec3 on, inside, outside;
    } cases[] = {{SolidKind::sphere, {3, 4, 0}, {3, 3, 0}, {3, 4, 1}},
                 {SolidKind::ellipsoid, {0, 3, 0}, {0, 2, 0}, {3, 3, 0}},
                 {SolidKind::box, {2, 3, 1}, {1, 2, 0}, {3, 3, 1}},
                 {SolidKind::cylinder, {3, 3, 4}, {3, 2, 3}, {3, 4, 4}},
                 {SolidKind::cone, {0, 3, 2}, {0, 0, 3}, {0, 3, 3}},
                 {SolidKind::torus, {3, 1, 4}, {3, 0, 4}, {3, 2, 4}},
                 {SolidKind::capsule, {3, 3, 4}, {3, 2, 3}, {0, 9, 0}},
                 {SolidKind::slab, {90, 2, -70}, {90, 1, -70}, {90, 3, -70}}};
    for (const auto& c : cases) {
        s.kind = c.kind;
        if (c.kind == SolidKind::ellipsoid) s.radii = {3, 3, 4};
        const SolidProgram program = make_solid_program(s, glm::dmat4(1), GridFrame{});
        EXPECT_EQ(exact_side(program, 2 * c.on), 0) << static_cast<int>(c.kind);
        EXPECT_EQ(exact_side(program, 2 * c.inside), -1) << static_cast<int>(c.kind);
        EXPECT_EQ(exact_side(program, 2 * c.outside), 1) << static_cast<int>(c.kind);
    }
}

}  // namespace
}  // namespace voxelume
