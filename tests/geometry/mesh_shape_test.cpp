// SPDX-License-Identifier: Apache-2.0
// The properties of meshes, and the surface that `auto` chooses for them.
#include "runtime/geometry/shape/mesh_shape.hpp"

#include <gmock/gmock.h>

#include <numbers>
#include <random>

#include "runtime/scene/parts/scene_affine.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

Mesh turned(Mesh mesh, const glm::dvec3& turn) {
    const glm::dmat3 map = rotation_from_turn(turn);
    for (glm::vec3& p : mesh.positions) p = glm::vec3(map * glm::dvec3(p));
    return mesh;
}

Mesh inside_out(Mesh mesh) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.x, t.y);
    return mesh;
}

/// A round tube from y = 0 to 2, without its ends.
Mesh open_tube(double radius, int around) {
    Mesh mesh;
    for (int i = 0; i < around; ++i)
        for (const double y : {0.0, 2.0}) {
            const double a = 2 * std::numbers::pi * i / around;
            mesh.positions.emplace_back(radius * std::sin(a), y, radius * std::cos(a));
        }
    const auto at = [&](int i, int end) { return uint32_t(i % around * 2 + end); };
    for (int i = 0; i < around; ++i) {
        mesh.triangles.emplace_back(at(i, 0), at(i + 1, 0), at(i + 1, 1));
        mesh.triangles.emplace_back(at(i, 0), at(i + 1, 1), at(i, 1));
    }
    return mesh;
}

const Mesh kPlate = box({-0.7f, 0.1f, -0.4f}, {0.9f, 0.15f, 0.8f});

TEST(MeshShape, OfAPlateHasItsLongEdgesAndThickness) {
    for (const glm::dvec3& turn : {glm::dvec3(0), glm::dvec3(25, 11, 40)}) {
        const MeshShape shape = shape_of(turned(kPlate, turn));
        EXPECT_NEAR(shape.creases.length, 4 * (1.6 + 1.2), 1e-5);
        if (turn == glm::dvec3(0)) {
            EXPECT_NEAR(shape.thickness.body, 0.05, 1e-6);
        } else {  // lines that enter near an edge leave through the side
            EXPECT_LT(shape.thickness.body, 0.0501);
        }
    }
}

TEST(MeshShape, OfEndlesslyManyEqualFacesHasNoThickness) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles.assign(30000, {0, 1, 2});  // 60 million crossings
    EXPECT_EQ(thickness_of(mesh).body, 0);
}

TEST(MeshShape, OfABallHasNoSharpEdgesAndAboutItsDiameter) {
    const MeshShape shape = shape_of(ball({0.3, -0.2, 0.1}, 0.5, 48, 24));
    EXPECT_EQ(shape.creases.length, 0);
    EXPECT_GT(shape.thickness.body, 0.3);
    EXPECT_LT(shape.thickness.body, 1.0);
}

TEST(MeshShape, OfAMeshWithSeamsIsThatOfTheWhole) {
    Mesh seams;  // each triangle has corners of its own
    const Mesh whole = turned(wavy_ring(12, 6), {10, 20, 30});
    for (const glm::uvec3& t : whole.triangles) {
        for (int corner = 0; corner < 3; ++corner)
            seams.positions.push_back(whole.positions[t[corner]]);
        const auto n = uint32_t(seams.positions.size());
        seams.triangles.emplace_back(n - 3, n - 2, n - 1);
    }
    const MeshShape shape = shape_of(whole);
    EXPECT_GT(shape.creases.length, 1) << "it is coarse";
    EXPECT_NEAR(shape_of(seams).creases.length, shape.creases.length, 1e-9);
    EXPECT_EQ(shape_of(seams).thickness.body, shape.thickness.body);
}

TEST(MeshShape, CountsEveryEdgeOfDoubledSheetsAsSharp) {
    EXPECT_GT(shape_of(doubled(wavy_ring(40, 20), true)).creases.length, 10);
}

SurfaceChoice choice(const Mesh& mesh, double voxel) {
    return surface_for(summary_of(mesh), shape_of(mesh), voxel);
}

void expect_choice(const Mesh& mesh, double voxel, Surface surface, const char* reason) {
    const SurfaceChoice chosen = choice(mesh, voxel);
    EXPECT_EQ(chosen.surface, surface) << chosen.reason;
    EXPECT_THAT(chosen.reason, HasSubstr(reason));
}

TEST(SurfaceFor, AClosedRoundThickMeshIsSmooth) {
    expect_choice(ball({0, 0, 0}, 0.5, 48, 24), 0.02, Surface::smooth, "closed");
    expect_choice(ball({0, 0, 0}, 0.5, 16, 8), 0.02, Surface::smooth, "closed");
    expect_choice(wavy_ring(160, 72), 0.01, Surface::smooth, "closed");
    expect_choice(turned(wavy_ring(40, 20), {10, 20, 30}), 0.01, Surface::smooth, "closed");
}

TEST(SurfaceFor, AMeshThatIsOpenSharpThinOrInsideOutIsExact) {
    expect_choice(open_tube(0.5, 30), 0.02, Surface::exact, "open at 60 edges");
    expect_choice(box({0, 0, 0}, {1, 2, 3}), 0.02, Surface::exact, "turn by 40 degrees");
    expect_choice(turned(box({0, 0, 0}, {1, 2, 3}), {10, 20, 30}), 0.02, Surface::exact,
                  "turn by 40 degrees");
    expect_choice(kPlate, 0.02, Surface::exact, "turn by 40 degrees");
    expect_choice(inside_out(wavy_ring(40, 20)), 0.01, Surface::exact, "inwards");
    expect_choice(doubled(wavy_ring(40, 20), true), 0.01, Surface::exact, "");
}

TEST(SurfaceFor, AMeshWithASmallHoleIsSmooth) {
    Mesh hole = wavy_ring(40, 20);
    hole.triangles.pop_back();
    expect_choice(hole, 0.01, Surface::smooth, "closed but for small holes");
}

TEST(SurfaceFor, ThinDependsOnTheVoxels) {
    const Mesh ring = wavy_ring(80, 40);  // its tube is 0.28 to 0.4 thick
    expect_choice(ring, 0.02, Surface::smooth, "thick");
    expect_choice(ring, 0.25, Surface::exact, "within a voxel");
    const MeshSummary plate = summary_of(kPlate);
    MeshShape round_plate = shape_of(kPlate);
    round_plate.creases.length = 0;
    EXPECT_EQ(surface_for(plate, round_plate, 0.024).surface, Surface::smooth);
    EXPECT_EQ(surface_for(plate, round_plate, 0.026).surface, Surface::exact);
}

TEST(SurfaceFor, AThinPartOfAThickMeshIsNotShredded) {
    Mesh fin = ball({0, 0, 0}, 0.5, 48, 24);
    const Mesh sheet = box({0.7f, 0, 0}, {0.83f, 0.13f, 0.004f});  // 1 % of the area
    const auto first = uint32_t(fin.positions.size());
    fin.positions.insert(fin.positions.end(), sheet.positions.begin(), sheet.positions.end());
    for (const glm::uvec3& t : sheet.triangles) fin.triangles.push_back(t + first);
    expect_choice(fin, 0.02, Surface::exact, "parts of it are only 0.2 voxels thick");
    expect_choice(fin, 0.0035, Surface::smooth, "thick");
}

TEST(SurfaceFor, NoiseDoesntMakeAMeshSharp) {
    constexpr unsigned kSeed = 20261123;
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<float> off(-1, 1);
    for (const float noise : {0.001f, 0.002f}) {
        Mesh mesh = wavy_ring(160, 72);
        for (glm::vec3& p : mesh.positions)
            p += noise * glm::vec3(off(random), off(random), off(random));
        EXPECT_EQ(choice(mesh, 0.01).surface, Surface::smooth) << noise << ", seed " << kSeed;
    }
    Mesh spike = wavy_ring(160, 72);
    spike.positions[1000] *= 1.15f;
    EXPECT_EQ(shape_of(spike).creases.length, 0);
}

/// A prism with flat ends, its corners on a circle of radius 1.
Mesh prism(int corners) {
    Mesh mesh = open_tube(1, corners);
    for (const uint32_t end : {0u, 1u})
        for (uint32_t i = 1; i + 1 < uint32_t(corners); ++i) {
            glm::uvec3 triangle(end, 2 * i + end, 2 * i + 2 + end);
            if (end == 0) std::swap(triangle.y, triangle.z);
            mesh.triangles.push_back(triangle);
        }
    return mesh;
}

/// A box around the origin whose edges are rounded, in `steps` for a right angle: a ball's faces,
/// moved apart.
Mesh rounded_box(const glm::dvec3& size, double radius, int steps) {
    const double pi = std::numbers::pi;
    const glm::dvec3 core = size / 2.0 - radius;
    const int around = 4 * (steps + 1), up = 2 * (steps + 1);
    Mesh mesh;
    for (int row = 0; row < up; ++row)
        for (int column = 0; column < around; ++column) {
            const int quarter = column / (steps + 1), half = row / (steps + 1);
            const double longitude = pi / 2 * (quarter + double(column % (steps + 1)) / steps),
                         latitude = pi / 2 * (half - 1 + double(row % (steps + 1)) / steps);
            const glm::dvec3 out(std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                                 std::cos(latitude) * std::sin(longitude));
            const glm::dvec3 side(quarter % 3 == 0 ? 1 : -1, half == 0 ? -1 : 1,
                                  quarter < 2 ? 1 : -1);
            mesh.positions.emplace_back(radius * out + side * core);
        }
    const auto at = [&](int row, int column) { return uint32_t(row * around + column % around); };
    for (int row = 0; row + 1 < up; ++row)
        for (int column = 0; column < around; ++column) {
            mesh.triangles.emplace_back(at(row, column), at(row + 1, column + 1),
                                        at(row, column + 1));
            mesh.triangles.emplace_back(at(row, column), at(row + 1, column),
                                        at(row + 1, column + 1));
        }
    const int q = steps + 1;
    for (const int row : {0, up - 1}) {
        const bool is_top = row > 0;
        for (const glm::ivec3 c : {glm::ivec3(0, q, 2 * q), glm::ivec3(0, 2 * q, 3 * q)})
            mesh.triangles.emplace_back(at(row, c.x), at(row, is_top ? c.z : c.y),
                                        at(row, is_top ? c.y : c.z));
    }
    return mesh;
}

Mesh joined(Mesh mesh, const Mesh& other, const glm::vec3& shift) {
    const auto first = uint32_t(mesh.positions.size());
    for (const glm::vec3& p : other.positions) mesh.positions.push_back(p + shift);
    for (const glm::uvec3& t : other.triangles) mesh.triangles.push_back(t + first);
    return mesh;
}

constexpr double kEdges = 4 * (1 + 0.4 + 0.6);  // of the box below

TEST(RoundedEdges, AreSharpWhereVoxelsAreLargerThanTheyAre) {
    for (const int steps : {3, 6, 8, 16})
        for (const glm::dvec3& turn : {glm::dvec3(0), glm::dvec3(25, 11, 40)}) {
            const Mesh mesh = turned(rounded_box({1, 0.4, 0.6}, 0.01, steps), turn);
            const MeshCreases creases = shape_of(mesh).creases;
            EXPECT_EQ(creases.length, 0) << steps;
            EXPECT_NEAR(creases.round_length, kEdges, 0.2 * kEdges) << steps;
            // An arc of 40 degrees, of which the mesh's edges show only the steps.
            EXPECT_GT(creases.round_width, 0.01 * 0.5) << steps;
            EXPECT_LT(creases.round_width, 0.01 * 0.8) << steps;
            expect_choice(mesh, 0.01, Surface::exact, "turn by 40 degrees or more within");
            expect_choice(mesh, 0.005, Surface::smooth, "closed");
        }
}

// The edges are rounded by a tenth of the side, and the voxels are a twelfth of it, as in a world
// that holds much else.
TEST(RoundedEdges, AreSharpInCoarseVoxels) {
    const Mesh mesh = rounded_box({1, 1, 1}, 0.1, 12);
    expect_choice(mesh, 1 / 12.0, Surface::exact, "turn by 40 degrees or more within");
    expect_choice(mesh, 1 / 24.0, Surface::smooth, "closed");
}

TEST(RoundedEdges, ScaleWithTheMesh) {
    const MeshShape shape = shape_of(rounded_box({1, 0.4, 0.6}, 0.02, 6));
    const MeshCreases half = scaled(shape, 0.5).creases;
    EXPECT_EQ(half.round_width, shape.creases.round_width / 2);
    EXPECT_EQ(half.round_length, shape.creases.round_length / 2);
    EXPECT_EQ(half.length, shape.creases.length / 2);
}

TEST(RoundedEdges, ArentThoseOfRoundBodies) {
    for (const double voxel : {0.01, 0.02, 0.03}) {
        expect_choice(ball({0, 0, 0}, 0.5, 96, 48), voxel, Surface::smooth, "closed");
        expect_choice(rounded_box({1, 0.4, 0.6}, 0.18, 12), voxel, Surface::smooth, "closed");
    }
    expect_choice(wavy_ring(160, 72), 0.05, Surface::smooth, "closed");
}

// Four faces meet at the edges that both bodies have.
TEST(RoundedEdges, OfBodiesThatShareCornersAreStillRound) {
    const Mesh part = rounded_box({1, 0.4, 0.6}, 0.125, 6);
    EXPECT_EQ(shape_of(joined(part, part, {0, 0, 0})).creases.length, 0);
    const Mesh longer = rounded_box({2, 0.4, 0.6}, 0.125, 6);
    EXPECT_EQ(shape_of(joined(part, longer, {0.5, 0, 0})).creases.length, 0);
}

TEST(MeshShape, OfACylinderHasItsTwoRims) {
    for (const int corners : {6, 12, 60}) {
        const double side = 2 * std::sin(std::numbers::pi / corners);
        const double along = corners < 9 ? corners * 2.0 : 0;  // where its sides meet sharply
        EXPECT_NEAR(shape_of(prism(corners)).creases.length, 2 * corners * side + along, 1e-5)
            << corners;
        expect_choice(prism(corners), 0.02, Surface::exact, "turn by 40 degrees");
    }
}

}  // namespace
}  // namespace voxelume
