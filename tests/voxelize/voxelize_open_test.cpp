// SPDX-License-Identifier: Apache-2.0
// Open meshes: a place is inside where the generalized winding number, summed in double, is above
// 1/2.
#include <gtest/gtest.h>

#include <glm/glm.hpp>

#include "runtime/stages/voxelize/mesh_lattice.hpp"
#include "tests/support/voxelize_fixture.hpp"

namespace voxelume {
namespace {

using glm::dvec3;
using glm::ivec3;

constexpr ivec3 kOpenSize(37, 34, 26);

/// The mesh's solid angle in turns, summed triangle by triangle.
double winding_of_angles(const dvec3& p, const std::vector<oracle::LatticeCorners>& mesh,
                         const dvec3& scale) {
    double sum = 0;
    for (const auto& t : mesh) {
        const dvec3 a = (dvec3(t[0]) / 4096.0 - p) * scale, b = (dvec3(t[1]) / 4096.0 - p) * scale,
                    c = (dvec3(t[2]) / 4096.0 - p) * scale;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        sum += std::atan2(
            glm::dot(a, glm::cross(b, c)),
            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return sum / (2 * M_PI);
}

Mesh without_triangles(Mesh mesh, size_t first, size_t count) {
    const auto at = mesh.triangles.begin() + std::ptrdiff_t(first);
    mesh.triangles.erase(at, at + std::ptrdiff_t(count));
    return mesh;
}

/// Compares SOLID with the sum of angles wherever that isn't near 1/2; returns the number of voxels
/// inside.
size_t expect_solid(const Mesh& mesh, Voxelizer& voxelizer = shared_voxelizer()) {
    const VoxelSetOf voxels = voxels_of(mesh, kOpenSize, VoxelSet::solid, voxelizer);
    const auto triangles = lattice_mesh(mesh);
    size_t wrong = 0, unclear = 0;
    for (int z = 0; z < kOpenSize.z; ++z)
        for (int y = 0; y < kOpenSize.y; ++y)
            for (int x = 0; x < kOpenSize.x; ++x) {
                const double w = winding_of_angles(dvec3(x, y, z) + 0.5, triangles, dvec3(1));
                if (std::abs(w - 0.5) < 1e-5)
                    ++unclear;
                else
                    wrong += (w > 0.5) != (voxels.count({x, y, z}) == 1);
            }
    EXPECT_EQ(wrong, 0u);
    EXPECT_LT(unclear, 1000u);
    return voxels.size();
}

TEST(OpenMesh, WithHolesIsFilledAsIfClosed) {
    const Mesh ball = ball_mesh({18.3f, 17.1f, 13.2f}, 9.7f, 24, 14);
    const size_t whole = expect_solid(ball);
    const size_t holed = expect_solid(without_triangles(without_triangles(ball, 300, 9), 41, 4));
    EXPECT_NEAR(double(holed), double(whole), 60.0);
}

TEST(OpenMesh, HemisphereIsClosedByTheSurfaceOfHalfAWinding) {
    // The outline lies first in the plane z = 13, which contains no centre, and then in one full of
    // centres.
    for (const float z : {13.0f, 12.5f}) {
        const size_t size = expect_solid(ball_mesh({18.3f, 17.1f, z}, 10, 24, 14, 0, 7));
        EXPECT_NEAR(double(size), 2094.4,
                    250.0);  // the lid's own layer of 314 voxels may be in or out
    }
}

TEST(OpenMesh, WarpedOutlinesAndSheetsFollowTheSumOfAngles) {
    Mesh mesh = ball_mesh({18.3f, 17.1f, 12.7f}, 10, 24, 14, 2, 9);
    add_triangle(mesh, {3, 4, 5}, {31, 6, 7}, {9, 29, 20});
    for (glm::vec3& p : mesh.positions) p.z += 2.5f * std::sin(0.4f * p.x);
    EXPECT_GT(expect_solid(mesh), 500u);
}

TEST(OpenMesh, FarBricksThatTheHalfWindingCrossesAreStored) {
    // A box without a lid has its outline far from a middle that bulges through several bricks.
    Mesh mesh = box_mesh({3, 3, 3}, {60, 55, 40});
    mesh.triangles.erase(mesh.triangles.begin() + 2, mesh.triangles.begin() + 4);
    for (glm::vec3& p : mesh.positions)
        if (p.z > 39 && p.x > 59) p.z -= 21;
    const ivec3 size(64, 59, 45);
    const VoxelSetOf voxels = voxels_of(mesh, size, VoxelSet::solid);
    const auto triangles = lattice_mesh(mesh);
    size_t wrong = 0;
    for (int z = 0; z < size.z; z += 2)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const double w = winding_of_angles(dvec3(x, y, z) + 0.5, triangles, dvec3(1));
                if (std::abs(w - 0.5) > 1e-5) wrong += (w > 0.5) != (voxels.count({x, y, z}) == 1);
            }
    EXPECT_EQ(wrong, 0u);
}

TEST(OpenMesh, BricksAroundALidAreHalfInside) {
    // The lid lies in a plane of bricks' middle points; all caps meet at one of them.
    const glm::vec3 middle(72.5f, 72.5f, 72.5f);
    const Mesh mesh = ball_mesh(middle, 60, 256, 64, 0, 32);
    const VoxelSetOf voxels = voxels_of(mesh, {145, 145, 90}, VoxelSet::solid);
    size_t wrong = 0;
    for (int z = 64; z < 80; ++z)
        for (int y = 0; y < 145; ++y)
            for (int x = 0; x < 145; ++x) {
                const glm::vec3 p(float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f);
                const float height = p.z - middle.z;
                const bool clear = glm::length(p - middle) < 59 && height != 0;
                wrong += clear && (height < 0) != voxels.contains({x, y, z});
            }
    EXPECT_EQ(wrong, 0u);
}

using Outline = std::vector<glm::vec2>;

/// Walls along a counter-clockwise outline, from a floor up to a rim, with corners every 2 voxels.
Mesh tray_mesh(const Outline& outline, float floor, float rim) {
    Mesh mesh;
    for (size_t i = 0; i < outline.size(); ++i) {
        const glm::vec2 from = outline[i], to = outline[(i + 1) % outline.size()];
        const int steps = int(std::lround(glm::length(to - from) / 2));
        for (int k = 0; k < steps; ++k) {
            const glm::vec2 p = glm::mix(from, to, float(k) / float(steps));
            mesh.positions.emplace_back(p, floor);
            mesh.positions.emplace_back(p, rim);
        }
    }
    const uint32_t size = uint32_t(mesh.positions.size());
    mesh.positions.emplace_back(outline[0] + glm::vec2(-20, 60),
                                floor);  // a point that sees all of the outline
    for (uint32_t i = 0; i < size; i += 2) {
        const uint32_t next = (i + 2) % size;
        mesh.triangles.emplace_back(i, next, next + 1);
        mesh.triangles.emplace_back(i, next + 1, i + 1);
        mesh.triangles.emplace_back(size, next, i);
    }
    return mesh;
}

bool is_within(const Outline& outline, glm::vec2 p) {
    bool within = false;
    for (size_t i = 0; i < outline.size(); ++i) {
        const glm::vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
        if ((a.y > p.y) != (b.y > p.y))
            within ^= p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y);
    }
    return within;
}

TEST(OpenMesh, ATrayWhoseLidsMiddleLiesOnTheLineOfAnEdgeIsFilledToItsRim) {
    Outline outline = {{0, 0}, {60, 0}, {60, 40}, {-20, 40}, {-20, -60}, {0, -60}};
    for (glm::vec2& p : outline) p = p * 4.0f + glm::vec2(87.5f, 255.5f);
    const ivec3 size(337, 420, 96);
    const VoxelSetOf voxels = voxels_of(tray_mesh(outline, 40.3f, 66.5f), size, VoxelSet::solid);
    size_t wrong = 0;
    for (int z = 42; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const glm::vec2 corner{float(x), float(y)};
                const bool expected = is_within(outline, corner + 0.6f);
                const bool near_outline = is_within(outline, corner + 0.4f) != expected;
                wrong +=
                    z != 66 && !near_outline && (z < 66 && expected) != voxels.contains({x, y, z});
            }
    EXPECT_EQ(wrong, 0u);
}

TEST(OpenMesh, CentresOnTheEdgesOfALidAreOnTheSideOfTheSum) {
    // The outline has eight corners, alternately up and down; its middle is a voxel's centre.
    Mesh mesh;
    const glm::vec3 middle(18.5f, 17.5f, 12.5f);
    const glm::vec3 outline[] = {{12, 0, 0},  {8, 8, 3},    {0, 12, 0},  {-8, 8, -3},
                                 {-12, 0, 0}, {-8, -8, -3}, {0, -12, 0}, {8, -8, 3}};
    for (const glm::vec3& corner : outline) mesh.positions.push_back(middle + corner * 1.03125f);
    mesh.positions.push_back(middle - glm::vec3(0.2f, 0.3f, 10.4f));
    for (uint32_t i = 0; i < 8; ++i) mesh.triangles.emplace_back(8, (i + 1) % 8, i);
    EXPECT_GT(expect_solid(mesh), 500u);
}

TEST(OpenMesh, SmoothSignsAreThoseOfTheSum) {
    const Mesh mesh = without_triangles(ball_mesh({18.3f, 17.1f, 13.2f}, 9.7f, 24, 14), 300, 60);
    GridFrame frame = unit_frame(kOpenSize);
    VoxelizeOptions options;
    options.surface = Surface::smooth;
    const BrickGrid grid = shared_voxelizer().voxelize(mesh, glm::dmat4(1), frame, options);
    const std::vector<uint32_t> slots = grid.slots.read();
    const std::vector<int16_t> distance = grid.distance.read();
    const auto triangles = lattice_mesh(mesh);
    size_t wrong = 0;
    for (int z = 0; z <= kOpenSize.z; ++z)
        for (int y = 0; y <= kOpenSize.y; ++y)
            for (int x = 0; x <= kOpenSize.x; ++x) {
                const GridSlot at = slot_in(grid, slots, {x, y, z});
                const int units = at.slot == kBrickInside ? -32767
                                  : at.slot == kBrickOutside
                                      ? 32767
                                      : distance.at(size_t(at.slot) * 4096 + at.number);
                const double w = winding_of_angles(dvec3(x, y, z), triangles, dvec3(1));
                if (std::abs(w - 0.5) > 1e-5 && units != 0) wrong += (w > 0.5) != (units < 0);
            }
    EXPECT_EQ(wrong, 0u);
}

TEST(OpenMesh, IsTheSameForEveryNumberOfLanes) {
    const Mesh mesh = ball_mesh({18.3f, 17.1f, 12.5f}, 10, 24, 14, 0, 8);
    VoxelSetOf expected;
    for (const int lanes : lanes_to_compare(2)) {
        Voxelizer voxelizer(test_device(lanes));
        const VoxelSetOf voxels = voxels_of(mesh, kOpenSize, VoxelSet::solid, voxelizer);
        if (expected.empty()) expected = voxels;
        EXPECT_EQ(difference(voxels, expected), "") << lanes << " lanes";
    }
}

TEST(Caps, AreNoneForSeamsAndClosedMeshes) {
    // ball_mesh gives each triangle its own corners, so only their positions pair them.
    const Mesh ball = ball_mesh({8, 7, 6}, 4, 12, 7);
    MeshLattice lattice = snap_to_lattice(ball, glm::dmat4(1), unit_frame({16, 15, 14}));
    cap_open_outlines(lattice);
    EXPECT_EQ(lattice.triangles.size(), ball.triangles.size());
}

TEST(Caps, FanFromTheMiddleOfEachOutline) {
    const Mesh ball = ball_mesh({8, 7, 6}, 4, 12, 7, 1, 6);
    MeshLattice lattice = snap_to_lattice(ball, glm::dmat4(1), unit_frame({16, 15, 14}));
    cap_open_outlines(lattice);
    EXPECT_EQ(lattice.surface_triangles, ball.triangles.size());
    EXPECT_EQ(lattice.triangles.size(), ball.triangles.size() + 24);
    EXPECT_EQ(lattice.vertices.size(), ball.positions.size() + 2);
}

}  // namespace
}  // namespace voxelume
