// SPDX-License-Identifier: Apache-2.0
// The voxels of closed meshes that are inside, against winding numbers in rationals.
#include <gtest/gtest.h>

#include "tests/support/voxelize_fixture.hpp"

namespace voxelume {
namespace {

using glm::ivec3;
using glm::vec3;

TEST(Solid, MatchesWindingNumbersInRationals) {
    const ivec3 size(33, 31, 18);
    Mesh mesh = torus_mesh({16, 15, 9}, 10, 4, 17, 9);
    EXPECT_EQ(difference(voxels_of(mesh, size, VoxelSet::solid), exact_solid(mesh, size)), "");
    // Corners lie on half voxels, so centres lie on edges and corners.
    for (vec3& p : mesh.positions) p = glm::round(p * 2.0f) / 2.0f;
    EXPECT_EQ(difference(voxels_of(mesh, size, VoxelSet::solid), exact_solid(mesh, size)), "");
}

TEST(Solid, CountsShellsLeftOfTheFrame) {
    const Mesh mesh = box_mesh({-300.3f, -20, -20}, {21.3f, 20.1f, 11.9f});
    const ivec3 size(37, 26, 18);
    EXPECT_EQ(difference(voxels_of(mesh, size, VoxelSet::solid), exact_solid(mesh, size)), "");
}

TEST(Solid, OfEightVoxelsHasAllEight) {
    EXPECT_EQ(voxels_of(box_mesh({0, 0, 0}, {8, 8, 8}), {8, 8, 8}, VoxelSet::solid).size(), 512u);
    // A face at 0.3 keeps the centre of voxel 0 inside; a face at 0.6 doesn't.
    EXPECT_EQ(voxels_of(box_mesh({0.3f, 0, 0}, {7, 5, 3}), {8, 6, 4}, VoxelSet::solid).size(),
              105u);
    EXPECT_EQ(voxels_of(box_mesh({0.6f, 0, 0}, {7, 5, 3}), {8, 6, 4}, VoxelSet::solid).size(), 90u);
}

Mesh joined(Mesh a, const Mesh& b, bool reversed) {
    const auto first = static_cast<uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (glm::uvec3 t : b.triangles) {
        if (reversed) std::swap(t.y, t.z);
        a.triangles.push_back(t + first);
    }
    return a;
}

TEST(Solid, OfDoubledNestedAndReversedShells) {
    const Mesh outer = box_mesh({2, 2, 2}, {20, 18, 13}), inner = box_mesh({6, 6, 5}, {15, 12, 9});
    const ivec3 size(23, 20, 15);
    const size_t full = 18 * 16 * 11, hole = 9 * 6 * 4;
    EXPECT_EQ(voxels_of(outer, size, VoxelSet::solid).size(), full);
    EXPECT_EQ(voxels_of(joined(outer, outer, false), size, VoxelSet::solid).size(), full);
    EXPECT_EQ(voxels_of(joined(outer, inner, false), size, VoxelSet::solid).size(), full);
    EXPECT_EQ(voxels_of(joined(outer, inner, true), size, VoxelSet::solid).size(), full - hole);
    EXPECT_TRUE(voxels_of(joined(Mesh{}, outer, true), size, VoxelSet::solid).empty());
}

TEST(Solid, TwoBallsWithAGapNeverMerge) {
    for (const double edge : {0.05, 0.062, 0.08, 0.099}) {
        const Mesh left = ball_mesh({1.2f, 1.2f, 1.2f}, 1, 40, 20);
        const Mesh both = joined(left, ball_mesh({3.3f, 1.2f, 1.2f}, 1, 40, 20), false);
        GridFrame frame;
        frame.voxel_edge = glm::dvec3(edge);
        frame.size = ivec3(glm::ceil(glm::dvec3(4.5, 2.4, 2.4) / edge));
        const VoxelSetOf voxels = occupied_voxels(
            shared_voxelizer().voxelize(both, glm::dmat4(1), frame, cubes(VoxelSet::solid)));
        EXPECT_GT(double(voxels.size()) * edge * edge * edge, 6);  // of 8.4 m^3
        for (const ivec3& v : voxels) {
            const double x = (v.x + 0.5) * edge;
            EXPECT_TRUE(x < 2.2001 || x > 2.2999) << x;
        }
    }
}

}  // namespace
}  // namespace voxelume
