// SPDX-License-Identifier: Apache-2.0
// Points and lines as cubes: half-open voxels, so that a scan on the lattice's planes isn't
// doubled.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "runtime/geometry/mesh_points.hpp"
#include "tests/support/voxelize_fixture.hpp"

namespace voxelume {
namespace {

using glm::ivec3;
using glm::vec3;

constexpr VoxelSet kAllSets[] = {VoxelSet::supercover, VoxelSet::thin, VoxelSet::solid};

/// Points each of whose coordinates is on a plane of the lattice with a probability of one half.
vec3 random_place(std::mt19937& random, const ivec3& size) {
    vec3 place;
    for (int axis = 0; axis < 3; ++axis) {
        place[axis] = std::uniform_real_distribution<float>(0.0f, float(size[axis]))(random);
        if (random() % 2 == 0) place[axis] = std::floor(place[axis]);
    }
    return place;
}

TEST(Points, AreInOneVoxelEachWhateverTheSet) {
    const ivec3 size(40, 35, 20);
    constexpr unsigned kSeed = 11;
    SCOPED_TRACE(testing::Message() << "seed " << kSeed);
    std::mt19937 random(kSeed);
    Mesh mesh;
    VoxelSetOf expected;
    for (int i = 0; i < 500; ++i) {
        mesh.positions.push_back(random_place(random, size));
        expected.insert(ivec3(glm::floor(mesh.positions.back())));
    }
    show_vertices(mesh);
    for (const VoxelSet set : kAllSets)
        EXPECT_EQ(difference(voxels_of(mesh, size, set), expected), "") << int(set);
}

TEST(Lines, AreInTheVoxelsThatTheyMeetAboveTheLowerPlanes) {
    const ivec3 size(40, 35, 20);
    constexpr unsigned kSeed = 12;
    SCOPED_TRACE(testing::Message() << "seed " << kSeed);
    std::mt19937 random(kSeed);
    for (int i = 0; i < 100; ++i) {
        Mesh mesh;
        const vec3 from = random_place(random, size), to = random_place(random, size);
        mesh.positions = {from, i % 3 == 0 ? vec3(from.x, from.y, to.z) : to};
        mesh.triangles = {line_triangle(0, 1)};
        const vec3 low = glm::min(mesh.positions[0], mesh.positions[1]);
        VoxelSetOf expected;
        for (const ivec3& voxel : exact_supercover(mesh, size))
            if (glm::all(glm::lessThan(low, vec3(voxel + 1)))) expected.insert(voxel);
        for (const VoxelSet set : kAllSets)
            EXPECT_EQ(difference(voxels_of(mesh, size, set), expected), "") << i << ' ' << int(set);
    }
}

TEST(Points, NextToATriangleAreOfTheClosedSet) {
    Mesh mesh = single_triangle({3, 3, 3}, {5, 3, 3}, {3, 5, 3});
    mesh.positions.emplace_back(8, 8, 8);
    mesh.triangles.push_back(point_triangle(3));
    const VoxelSetOf voxels = voxels_of(mesh, {12, 12, 12}, VoxelSet::supercover);
    EXPECT_EQ(voxels.count({7, 7, 7}) + voxels.count({8, 8, 8}), 2u);
}

}  // namespace
}  // namespace voxelume
