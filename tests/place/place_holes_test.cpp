// SPDX-License-Identifier: Apache-2.0
// Placed cubes are as closed as the object's voxels: no holes in solids, no leaks through shells.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/stages/place/place.hpp"
#include "tests/place/placing.hpp"

namespace voxelume {
namespace {

/// The voxels that paths through faces reach from the world's corner without entering `set`.
struct Flood {
    Flood(const VoxelMap& set, const glm::ivec3& world_size) : size(world_size) {
        seen.assign(size_t(size.x) * size_t(size.y) * size_t(size.z), 0);
        for (const auto& [v, word] : set) seen[index(v)] = 2;
        std::vector<glm::ivec3> open = {{0, 0, 0}};
        while (!open.empty()) {
            const glm::ivec3 v = open.back();
            open.pop_back();
            if (glm::any(glm::lessThan(v, glm::ivec3(0))) ||
                glm::any(glm::greaterThanEqual(v, size)) || seen[index(v)] != 0)
                continue;
            seen[index(v)] = 1;
            for (int axis = 0; axis < 3; ++axis)
                for (const int step : {-1, 1}) {
                    open.push_back(v);
                    open.back()[axis] += step;
                }
        }
    }
    size_t index(const glm::ivec3& v) const {
        return size_t(v.x) + size_t(size.x) * (size_t(v.y) + size_t(size.y) * size_t(v.z));
    }
    size_t count() const { return size_t(std::ranges::count(seen, 1)); }
    bool reaches(const glm::ivec3& v) const { return seen[index(v)] == 1; }

    glm::ivec3 size;
    std::vector<uint8_t> seen;  // 0 not reached, 1 reached, 2 set
};

/// A box's voxels, or only its outermost ones.
HostBricks box_bricks(const glm::ivec3& size, bool hollow) {
    VoxelMap voxels;
    for (glm::ivec3 v{0}; v.z < size.z; ++v.z)
        for (v.y = 0; v.y < size.y; ++v.y)
            for (v.x = 0; v.x < size.x; ++v.x)
                if (!hollow || glm::any(glm::equal(v, glm::ivec3(0))) ||
                    glm::any(glm::equal(v, size - 1)))
                    voxels[v] = 0;
    HostBricks bricks =
        occupied_bricks(frame_at(-glm::dvec3(size) / 2.0, glm::dvec3(1), size), voxels);
    bricks.attributes.clear();
    return bricks;
}

TEST(PlaceHoles, TurnedSolidBoxesHaveNoHoles) {
    const BrickGrid box = box_bricks({14, 9, 11}, false).upload(shared_device());
    const GridFrame world = frame_at(glm::dvec3(-12.3), glm::dvec3(1), {25, 25, 25});
    for (int angle = 0; angle <= 90; ++angle) {
        const VoxelMap placed = place_cubes(
            box, affine_from_factors({0, 0, 0}, {double(angle), 17, 0}, {1, 1, 1}), world);
        const size_t outside = Flood(placed, world.size).count();
        ASSERT_EQ(placed.size() + outside, 25u * 25u * 25u) << angle << " degrees";
        ASSERT_NEAR(double(placed.size()), 14 * 9 * 11, 60) << angle << " degrees";
    }
}

TEST(PlaceHoles, TurnedShrunkAndStretchedShellsLetNoPathThroughFacesIn) {
    const BrickGrid shell = box_bricks({34, 29, 31}, true).upload(shared_device());
    const GridFrame world = frame_at(glm::dvec3(-30.3), glm::dvec3(1), {61, 62, 63});
    for (const glm::dvec3 scale : {glm::dvec3(1), glm::dvec3(0.77), glm::dvec3(0.31),
                                   glm::dvec3(0.9, 0.4, 1.3), glm::dvec3(-0.6, 1.2, 1)})
        for (int angle = 0; angle <= 90; angle += 9) {
            const VoxelMap placed = place_cubes(
                shell, affine_from_factors({0, 0, 0}, {double(angle), 31, 12}, scale), world);
            ASSERT_FALSE(Flood(placed, world.size).reaches({30, 30, 30}))
                << angle << " degrees, scale " << scale.x << " " << scale.y;
        }
}

TEST(PlaceHoles, TurnedThinShellsLetNoPathThroughFacesIn) {
    VoxelMap voxels;  // |x|+|y|+|z| is about 12: voxels that meet only along edges
    for (glm::ivec3 v{0}; v.z < 25; ++v.z)
        for (v.y = 0; v.y < 25; ++v.y)
            for (v.x = 0; v.x < 25; ++v.x) {
                const glm::ivec3 d = glm::abs(v - 12);
                if (d.x + d.y + d.z == 11) voxels[v] = 0;
            }
    HostBricks bricks =
        occupied_bricks(frame_at(glm::dvec3(-12.5), glm::dvec3(1), {25, 25, 25}), voxels);
    bricks.attributes.clear();
    const BrickGrid shell = bricks.upload(shared_device());
    const GridFrame world = frame_at(glm::dvec3(-15.3), glm::dvec3(1), {31, 31, 31});
    for (int angle = 3; angle <= 90; angle += 6) {
        const VoxelMap placed =
            place_cubes(shell, affine_from_factors({0, 0, 0}, {double(angle), 20, 5}, {1, 1, 1}),
                        world, VoxelSet::thin);
        ASSERT_FALSE(Flood(placed, world.size).reaches({15, 15, 15})) << angle;
    }
    EXPECT_EQ(place_cubes(shell, glm::dmat4(1.0), shell.frame, VoxelSet::thin), voxels)
        << "on the lattice nothing is widened";
}

TEST(PlaceHoles, StoresEveryBrickOfASolidWithAVoxelNextToAnEmptyOne) {
    const glm::ivec3 size{112, 115, 113};
    VoxelMap ball;
    for (glm::ivec3 v{0}; v.z < size.z; ++v.z)
        for (v.y = 0; v.y < size.y; ++v.y)
            for (v.x = 0; v.x < size.x; ++v.x)
                if (glm::length(glm::dvec3(v) - glm::dvec3{56, 56, 55}) < 54) ball[v] = 0;
    HostBricks bricks = occupied_bricks(frame_at(glm::dvec3(-56), glm::dvec3(1), size), ball);
    bricks.attributes.clear();
    HostBricks sparse(bricks.frame);  // the grid without its full inner bricks, which aren't stored
    for (size_t i = 0; i < bricks.slots.size(); ++i) {
        const glm::ivec3 n = bricks.frame.bricks(),
                         low =
                             glm::ivec3(int(i) % n.x, int(i) / n.x % n.y, int(i) / n.x / n.y) * 16;
        bool full = true;
        for (int c = 0; c < 18 * 18 * 18 && full; ++c)
            full = ball.contains(low + glm::ivec3(c % 18, c / 18 % 18, c / 324) - 1);
        sparse.slots[i] = full                               ? kBrickInside
                          : bricks.slots[i] == kBrickOutside ? kBrickOutside
                                                             : 0;
    }
    sparse.number_slots();
    for (const uint32_t brick : sparse.coordinates)
        for (int leaf = 0; leaf < 64; ++leaf)
            sparse.occupancy.push_back(
                bricks.occupancy[size_t(bricks.slots[brick]) * 64 + size_t(leaf)]);
    ASSERT_LT(sparse.coordinates.size(), bricks.coordinates.size());
    const glm::dmat4 map = affine_from_factors({1, 2, 3}, {4, 3, 2}, {1, 1, 1});
    const GridFrame world = frame_at(glm::dvec3(-60), glm::dvec3(1), {121, 122, 123});
    const Device& device = shared_device();
    const BrickGrid grid = sparse.upload(device);
    const std::vector<PlacedObject> objects = {
        {.grid = &grid, .world_from_object = map, .material_of_group = {0}}};
    const ReadBricks placed(place(device, objects, world));
    EXPECT_EQ(placed.voxels(), place_cubes(bricks.upload(device), map, world));
    size_t full_voxels = 0;
    for (const auto& [v, word] : placed.voxels()) {
        if (placed.slot(v) != kBrickInside) continue;
        ++full_voxels;
        for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                glm::ivec3 next = v;
                next[axis] += step;
                ASSERT_TRUE(placed.is_set(next));
            }
    }
    EXPECT_GT(full_voxels, 0u);
}

}  // namespace
}  // namespace voxelume
