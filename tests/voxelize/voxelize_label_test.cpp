// SPDX-License-Identifier: Apache-2.0
// The data of voxels: their triangles, their group, their colour.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/shared/voxel.h"
#include "tests/oracles/mesh/triangle_distance.hpp"
#include "tests/support/voxelize_fixture.hpp"

namespace voxelume {
namespace {

using glm::dvec3;
using glm::ivec3;

constexpr ivec3 kLabelSize(33, 31, 18);

VoxelizeOptions surface(Surface kind) {
    VoxelizeOptions options;
    options.surface = kind;
    return options;
}

BrickGrid grid_of(const Mesh& mesh, const VoxelizeOptions& options) {
    return shared_voxelizer().voxelize(mesh, glm::dmat4(1), unit_frame(kLabelSize), options);
}

/// A torus whose triangles belong to three groups in turn, `run` at a time.
Mesh grouped_torus(uint32_t run) {
    Mesh mesh = torus_mesh({16.3f, 15.1f, 9.2f}, 9.7f, 4.3f, 31, 17);
    mesh.group_names = {"red", "green", "blue"};
    for (uint32_t i = 0; i < mesh.triangles.size(); ++i) mesh.triangle_group.push_back(i / run % 3);
    return mesh;
}

// Rays meet the corners before they are rounded to the lattice, so cubes are widened by one unit of
// it.
TEST(ExactVoxels, ListTheTrianglesThatTheirWidenedCubesMeetInOrder) {
    Mesh mesh = torus_mesh({16.3f, 15.1f, 9.2f}, 9.7f, 4.3f, 31, 17);
    add_triangle(mesh, {2, 2, 2}, {2, 2, 2}, {2, 2, 2});
    const BrickGrid grid = grid_of(mesh, surface(Surface::exact));
    const std::vector<uint32_t> slots = grid.slots.read(), first = grid.primitive_first.read(),
                                primitives = grid.primitives.read();
    const auto triangles = lattice_mesh(mesh);
    ASSERT_EQ(first.size(), 4096u * grid.brick_count + 1);
    EXPECT_EQ(first.back(), primitives.size());
    size_t listed = 0;
    for (int z = 0; z < kLabelSize.z; ++z)
        for (int y = 0; y < kLabelSize.y; ++y)
            for (int x = 0; x < kLabelSize.x; ++x) {
                std::vector<uint32_t> expected, actual;
                for (uint32_t i = 0; i < triangles.size(); ++i)
                    if (oracle::cube_meets_triangle({x, y, z}, triangles[i], 1))
                        expected.push_back(i);
                const GridSlot at = slot_in(grid, slots, {x, y, z});
                if (at.slot < kBrickInside) {
                    const size_t v = 4096 * size_t(at.slot) + at.number;
                    actual.assign(primitives.begin() + first[v], primitives.begin() + first[v + 1]);
                }
                ASSERT_EQ(actual, expected) << x << " " << y << " " << z;
                listed += actual.size();
            }
    EXPECT_EQ(listed, primitives.size());
    EXPECT_EQ(difference(occupied_voxels(grid), exact_supercover(mesh, kLabelSize, 1)), "");
}

TEST(ExactVoxels, KeepTheSourceTrianglesInVoxels) {
    Mesh mesh = single_triangle({1.1f, 2.2f, 3.3f}, {4.4f, 2.5f, 3.6f}, {1.7f, 5.8f, 3.9f});
    mesh.triangle_group = {2};
    GridFrame frame = unit_frame(kLabelSize);
    frame.origin = {1, 0, 0};
    frame.voxel_edge = {0.5, 1, 0.25};
    const BrickGrid grid =
        shared_voxelizer().voxelize(mesh, glm::dmat4(1), frame, surface(Surface::exact));
    EXPECT_THAT(grid.triangles.read(),
                testing::Pointwise(testing::FloatNear(1e-6f),
                                   {0.2f, 2.2f, 13.2f, 6.8f, 2.5f, 14.4f, 1.4f, 5.8f, 15.6f}));
    EXPECT_THAT(grid.triangle_attributes.read(), testing::ElementsAre(2u << 30 | 2u << 16));
}

TEST(Labels, AreLeftOutForOneGroupAndNoColors) {
    Mesh mesh = grouped_torus(1);
    mesh.triangle_group.assign(mesh.triangles.size(), 0);
    for (const Surface kind : {Surface::cubes, Surface::smooth, Surface::exact}) {
        const BrickGrid grid = grid_of(mesh, surface(kind));
        EXPECT_TRUE(grid.attributes.empty());
        EXPECT_TRUE(grid.colors.empty());
        EXPECT_EQ(grid.attribute, static_cast<uint32_t>(kind) << VXL_KIND_SHIFT);
    }
}

TEST(Labels, AreOfTheTriangleClosestToTheCentre) {
    const Mesh mesh = grouped_torus(5);
    const auto triangles = lattice_mesh(mesh);
    for (const Surface kind : {Surface::cubes, Surface::smooth}) {
        const BrickGrid grid = grid_of(mesh, surface(kind));
        const std::vector<uint32_t> slots = grid.slots.read(), words = grid.attributes.read();
        size_t checked = 0;
        for (int z = 0; z < kLabelSize.z; ++z)
            for (int y = 0; y < kLabelSize.y; ++y)
                for (int x = 0; x < kLabelSize.x; ++x) {
                    const GridSlot at = slot_in(grid, slots, {x, y, z});
                    if (at.slot >= kBrickInside) continue;
                    double best[3] = {9, 9, 9};
                    for (uint32_t i = 0; i < triangles.size(); ++i) {
                        const auto corner = [&](int c) { return dvec3(triangles[i][c]) / 4096.0; };
                        double& of_group = best[mesh.triangle_group[i]];
                        of_group = std::min(
                            of_group, oracle::distance_to_triangle(dvec3(x, y, z) + 0.5, corner(0),
                                                                   corner(1), corner(2)));
                    }
                    const auto group =
                        static_cast<uint32_t>(std::min_element(best, best + 3) - best);
                    std::sort(best, best + 3);
                    if (best[0] > 1.2 || best[1] - best[0] < 1e-4) continue;
                    ASSERT_EQ(words.at(size_t(at.slot) * 4096 + at.number),
                              static_cast<uint32_t>(kind) << 30 | group << 16)
                        << x << " " << y << " " << z;
                    ++checked;
                }
        EXPECT_GT(checked, 1500u);
    }
}

TEST(Labels, EquallyCloseTrianglesGiveTheLowestNumber) {
    Mesh mesh = single_triangle({1, 1, 2.5f}, {30, 2, 2.5f}, {3, 28, 2.5f});
    mesh.positions.push_back({2, 1, 2.5f});
    mesh.triangles = {{0, 1, 2}, {0, 1, 2}, {2, 1, 0}};
    mesh.triangle_group = {1, 2, 0};
    const BrickGrid grid = grid_of(mesh, surface(Surface::cubes));
    const GridSlot at = slot_in(grid, grid.slots.read(), {10, 9, 2});
    EXPECT_EQ(grid.attributes.read().at(size_t(at.slot) * 4096 + at.number), 1u << 16);
}

TEST(Labels, ColorsAreTheClosestPointsInSrgb) {
    Mesh mesh = single_triangle({0.5f, 0.5f, 2.5f}, {20.5f, 0.5f, 2.5f}, {0.5f, 20.5f, 2.5f});
    mesh.vertex_colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 0.21404114f}};  // sRGB 0.5
    const BrickGrid grid = grid_of(mesh, surface(Surface::cubes));
    const std::vector<uint32_t> slots = grid.slots.read(), colors = grid.colors.read();
    const auto color = [&](const ivec3& v) {
        const GridSlot at = slot_in(grid, slots, v);
        return colors.at(size_t(at.slot) * 4096 + at.number);
    };
    EXPECT_EQ(color({0, 0, 2}), 0x0000FFu);
    EXPECT_EQ(color({20, 0, 2}), 0x00FF00u);
    EXPECT_EQ(color({0, 20, 2}), 0x800000u);
    EXPECT_EQ(color({10, 0, 2}), 0x00BCBCu);  // the mean in linear light
    EXPECT_TRUE(grid.attributes.empty());
}

TEST(Labels, ColorsOfCornersGoBeforeTheOrderOfVertices) {
    Mesh mesh = single_triangle({0.5f, 0.5f, 2.5f}, {20.5f, 0.5f, 2.5f}, {0.5f, 20.5f, 2.5f});
    add_triangle(mesh, {0.5f, 0.5f, 9.5f}, {20.5f, 0.5f, 9.5f}, {0.5f, 20.5f, 9.5f});
    mesh.vertex_colors = {{1, 0, 0}, {0, 1, 0}};
    mesh.triangle_colors = {{1, 1, 1}, {0, 1, 0}};
    for (const bool mirrored : {false, true}) {
        const BrickGrid grid = shared_voxelizer().voxelize(
            mesh,
            mirrored ? glm::dmat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}, {0, 0, 12, 1})
                     : glm::dmat4(1),
            unit_frame(kLabelSize), surface(Surface::cubes));
        const std::vector<uint32_t> slots = grid.slots.read(), colors = grid.colors.read();
        const auto color = [&](int x, int y, int z) {
            const GridSlot at = slot_in(grid, slots, {x, y, z});
            return colors.at(size_t(at.slot) * 4096 + at.number);
        };
        const int of_first = mirrored ? 9 : 2, of_second = mirrored ? 2 : 9;
        EXPECT_EQ(color(5, 5, of_first), 0x00FF00u);
        EXPECT_EQ(color(0, 0, of_second), 0x0000FFu);
        EXPECT_EQ(color(20, 0, of_second), 0x00FF00u);
        EXPECT_EQ(color(0, 20, of_second), 0x0000FFu);
    }
}

TEST(Labels, AreTheSameForEveryNumberOfLanes) {
    Mesh mesh = grouped_torus(2);
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.vertex_colors.emplace_back(float(i % 7) / 6, float(i % 11) / 10, float(i % 5) / 4);
    std::vector<uint32_t> words, colors, primitives;
    for (const int lanes : lanes_to_compare(1)) {
        Voxelizer voxelizer(test_device(lanes));
        const BrickGrid grid = voxelizer.voxelize(mesh, glm::dmat4(1), unit_frame(kLabelSize),
                                                  surface(Surface::exact));
        if (words.empty()) {
            words = grid.attributes.read();
            colors = grid.colors.read();
            primitives = grid.primitives.read();
        }
        EXPECT_EQ(grid.attributes.read(), words) << lanes << " lanes";
        EXPECT_EQ(grid.colors.read(), colors) << lanes << " lanes";
        EXPECT_EQ(grid.primitives.read(), primitives) << lanes << " lanes";
    }
}

}  // namespace
}  // namespace voxelume
