#include "runtime/stages/place.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "runtime/error.hpp"
#include "runtime/scene_affine.hpp"
#include "tests/brick_grids.hpp"
#include "tests/test_device.hpp"

namespace voxelume {
namespace {

using ::testing::HasSubstr;

GridFrame frame_at(const glm::dvec3& origin, const glm::dvec3& edge, const glm::ivec3& size) {
    return {.origin = origin, .voxel_edge = edge, .size = size};
}

/// Places a grid of cubes alone and reads the world's voxels back; all have word 0.
VoxelMap place_cubes(const BrickGrid& grid, const glm::dmat4& world_from_object,
                     const GridFrame& world, VoxelSet set = VoxelSet::supercover) {
    const std::vector<PlacedObject> objects = {{.grid = &grid,
                                                .world_from_object = world_from_object,
                                                .material_of_group = {0},
                                                .set = set}};
    return ReadBricks(place(test_device(), objects, world)).voxels();
}

VoxelMap voxels_of(std::initializer_list<glm::ivec3> voxels) {
    VoxelMap map;
    for (const glm::ivec3& v : voxels) map[v] = 0;
    return map;
}

BrickGrid tricube() {
    const VoxelMap voxels = voxels_of({{1, 2, 3}, {2, 2, 3}, {1, 3, 3}});
    return occupied_bricks(frame_of({4, 5, 6}), voxels).upload(test_device());
}

const GridFrame kAround = frame_at(glm::dvec3(-8), glm::dvec3(1), {17, 18, 19});

TEST(Place, YawByAQuarterTurnTakesXToMinusZ) {
    EXPECT_EQ(
        place_cubes(tricube(), affine_from_factors({0, 0, 0}, {90, 0, 0}, {1, 1, 1}), kAround),
        voxels_of({{11, 10, 6}, {11, 10, 5}, {11, 11, 6}}));
}

TEST(Place, PitchByAQuarterTurnTakesYToZ) {
    EXPECT_EQ(
        place_cubes(tricube(), affine_from_factors({0, 0, 0}, {0, 90, 0}, {1, 1, 1}), kAround),
        voxels_of({{9, 4, 10}, {10, 4, 10}, {9, 4, 11}}));
}

TEST(Place, RollByAQuarterTurnTakesXToY) {
    EXPECT_EQ(
        place_cubes(tricube(), affine_from_factors({0, 0, 0}, {0, 0, 90}, {1, 1, 1}), kAround),
        voxels_of({{5, 9, 11}, {5, 10, 11}, {4, 9, 11}}));
}

TEST(Place, MirrorsAndDoublesAndHalves) {
    EXPECT_EQ(
        place_cubes(tricube(), affine_from_factors({0, 0, 0}, {0, 0, 0}, {-1, 1, 1}), kAround),
        voxels_of({{6, 10, 11}, {5, 10, 11}, {6, 11, 11}}));
    const VoxelMap doubled =
        place_cubes(tricube(), affine_from_factors({0, 0, 0}, {0, 0, 0}, {2, 2, 2}), kAround);
    EXPECT_EQ(doubled.size(), 24u);
    for (const auto& [v, word] : doubled) {
        const glm::ivec3 source = (v - 8) / 2;
        EXPECT_TRUE(source == glm::ivec3(1, 2, 3) || source == glm::ivec3(2, 2, 3) ||
                    source == glm::ivec3(1, 3, 3));
    }
    EXPECT_EQ(
        place_cubes(tricube(), affine_from_factors({0, 0, 0}, {0, 0, 0}, {.5, .5, .5}), kAround),
        voxels_of({{8, 9, 9}, {9, 9, 9}}));
}

/// A lump without symmetry.
VoxelMap random_lump(uint32_t seed, const glm::ivec3& size) {
    std::mt19937 random(seed);
    VoxelMap voxels;
    for (glm::ivec3 v{0}; v.z < size.z; ++v.z)
        for (v.y = 0; v.y < size.y; ++v.y)
            for (v.x = 0; v.x < size.x; ++v.x)
                if (random() % 3 != 0) voxels[v] = 0;
    return voxels;
}

TEST(Place, MovesByWholeVoxelsExactlyEvenFarFromTheOrigin) {
    const VoxelMap lump = random_lump(11, {21, 13, 18});
    HostBricks bricks =
        occupied_bricks(frame_at({0.3, -0.7, 0.1}, glm::dvec3(0.1), {21, 13, 18}), lump);
    bricks.attributes.clear();
    const BrickGrid grid = bricks.upload(test_device());
    for (const double far : {0.0, 1e4, 1e5}) {
        const GridFrame world =
            frame_at(glm::dvec3(far) + glm::dvec3{-0.3, -1.9, 0.6}, glm::dvec3(0.1), {40, 30, 35});
        glm::dmat4 map(1.0);
        map[3] = {far + 0.4, far - 0.5, far + 0.8, 1};
        VoxelMap expected;
        for (const auto& [v, word] : lump) expected[v + glm::ivec3{10, 7, 3}] = 0;
        EXPECT_EQ(place_cubes(grid, map, world), expected) << far;
    }
}

TEST(Place, AFullTurnInTenthsIsTheIdentity) {
    const VoxelMap lump = random_lump(12, {13, 14, 15});
    HostBricks bricks = occupied_bricks(frame_at({-6, -7, -7}, glm::dvec3(1), {13, 14, 15}), lump);
    bricks.attributes.clear();
    const BrickGrid grid = bricks.upload(test_device());
    glm::dmat3 turn(1.0);
    for (int i = 0; i < 36; ++i) turn = rotation_from_turn({10, 0, 0}) * turn;
    EXPECT_EQ(place_cubes(grid, glm::dmat4(turn), grid.frame), lump);
}

TEST(Place, SamplesTheVoxelThatTheCentreFallsInForAGeneralMap) {
    constexpr uint32_t kSeed = 4;
    const glm::ivec3 size{33, 20, 27};
    const VoxelMap lump = random_lump(kSeed, size);
    HostBricks bricks = occupied_bricks(frame_at({-1.5, -1, -1.2}, {0.1, 0.1, 0.1}, size), lump);
    bricks.attributes.clear();
    const BrickGrid grid = bricks.upload(test_device());
    glm::dmat4 map = affine_from_factors({0.13, -0.21, 0.34}, {33, -21, 57}, {1.3, -1.1, 1.9});
    map[1] += 0.2 * map[0];  // a shear
    const GridFrame world = frame_at({-3.01, -3.02, -3.03}, {0.05, 0.06, 0.07}, {127, 98, 85});
    const VoxelMap placed = place_cubes(grid, map, world);
    const glm::dmat4 inverse = glm::inverse(map);
    size_t found = 0;
    for (glm::ivec3 v{0}; v.z < world.size.z; ++v.z)
        for (v.y = 0; v.y < world.size.y; ++v.y)
            for (v.x = 0; v.x < world.size.x; ++v.x) {
                const glm::dvec3 centre = world.origin + world.voxel_edge * (glm::dvec3(v) + 0.5);
                const glm::dvec3 p =
                    (glm::dvec3(inverse * glm::dvec4(centre, 1)) - grid.frame.origin) /
                    grid.frame.voxel_edge;
                const glm::dvec3 gap = glm::abs(p - glm::round(p));
                if (std::min({gap.x, gap.y, gap.z}) < 1e-6) continue;
                const bool expected = lump.contains(glm::ivec3(glm::floor(p)));
                found += expected;
                ASSERT_EQ(placed.contains(v), expected)
                    << "seed " << kSeed << " at " << v.x << " " << v.y << " " << v.z;
            }
    EXPECT_GT(found, 10000u);
}

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

TEST(Place, TurnedSolidBoxesHaveNoHoles) {
    const BrickGrid box = box_bricks({14, 9, 11}, false).upload(test_device());
    const GridFrame world = frame_at(glm::dvec3(-12.3), glm::dvec3(1), {25, 25, 25});
    for (int angle = 0; angle <= 90; ++angle) {
        const VoxelMap placed = place_cubes(
            box, affine_from_factors({0, 0, 0}, {double(angle), 17, 0}, {1, 1, 1}), world);
        const size_t outside = Flood(placed, world.size).count();
        ASSERT_EQ(placed.size() + outside, 25u * 25u * 25u) << angle << " degrees";
        ASSERT_NEAR(double(placed.size()), 14 * 9 * 11, 60) << angle << " degrees";
    }
}

TEST(Place, TurnedShrunkAndStretchedShellsLetNoPathThroughFacesIn) {
    const BrickGrid shell = box_bricks({34, 29, 31}, true).upload(test_device());
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

TEST(Place, TurnedThinShellsLetNoPathThroughFacesIn) {
    VoxelMap voxels;  // |x|+|y|+|z| about 12: voxels that meet only along edges
    for (glm::ivec3 v{0}; v.z < 25; ++v.z)
        for (v.y = 0; v.y < 25; ++v.y)
            for (v.x = 0; v.x < 25; ++v.x) {
                const glm::ivec3 d = glm::abs(v - 12);
                if (d.x + d.y + d.z == 11) voxels[v] = 0;
            }
    HostBricks bricks =
        occupied_bricks(frame_at(glm::dvec3(-12.5), glm::dvec3(1), {25, 25, 25}), voxels);
    bricks.attributes.clear();
    const BrickGrid shell = bricks.upload(test_device());
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

TEST(Place, StoresEveryBrickOfASolidWithAVoxelBesideAnEmptyOne) {
    const glm::ivec3 size{112, 115, 113};
    VoxelMap ball;
    for (glm::ivec3 v{0}; v.z < size.z; ++v.z)
        for (v.y = 0; v.y < size.y; ++v.y)
            for (v.x = 0; v.x < size.x; ++v.x)
                if (glm::length(glm::dvec3(v) - glm::dvec3{56, 56, 55}) < 54) ball[v] = 0;
    HostBricks bricks = occupied_bricks(frame_at(glm::dvec3(-56), glm::dvec3(1), size), ball);
    bricks.attributes.clear();
    HostBricks sparse(bricks.frame);  // the same with its full inner bricks not stored
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
    const Device device = test_device();
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

TEST(Place, RefusesMapsThatCanNotBeInverted) {
    const BrickGrid grid = tricube();
    const auto message_of = [&](const glm::dmat4& map) -> std::string {
        try {
            place_cubes(grid, map, kAround);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::scene);
            return error.what();
        }
        return "placed";
    };
    EXPECT_THAT(message_of(affine_from_factors({0, 0, 0}, {0, 0, 0}, {1, 0, 1})),
                HasSubstr("flattens"));
    EXPECT_THAT(message_of(affine_from_factors({0, 0, 0}, {5, 6, 7}, {1, 2e-6, 1})),
                HasSubstr("stretches one direction 5e+05 times"));
    EXPECT_THAT(message_of(affine_from_factors({1e300 * 1e10, 0, 0}, {0, 0, 0}, {1, 1, 1})),
                HasSubstr("not finite"));
    EXPECT_THAT(message_of(affine_from_factors({1e30, 0, 0}, {0, 0, 0}, {1, 1, 1})),
                HasSubstr("too far"));
    EXPECT_EQ(message_of(affine_from_factors({0, 0, 0}, {5, 6, 7}, {1, 1e-4, 1})), "placed");
}

TEST(Place, OverlapsShowThePriorityThenTheEarlierObjectInAnyOrderOfTheList) {
    const Device device = test_device();
    const glm::ivec3 size{20, 18, 7};
    std::vector<BrickGrid> grids;
    std::vector<VoxelMap> lumps;
    for (const uint32_t seed : {1u, 2u, 3u, 4u}) {
        lumps.push_back(random_lump(seed, size));
        HostBricks bricks = occupied_bricks(frame_of(size), lumps.back());
        for (size_t i = 0; i < bricks.attributes.size(); ++i)
            bricks.attributes[i] = uint32_t(i % 4096 % 3) << 16;
        grids.push_back(bricks.upload(device));
    }
    const int priorities[] = {5, 9, 5, -2};
    std::vector<size_t> order = {0, 1, 2, 3};
    do {
        std::vector<PlacedObject> objects;
        for (const size_t i : order)
            objects.push_back({.grid = &grids[i],
                               .object = uint32_t(10 + i),
                               .priority = priorities[i],
                               .material_of_group = {uint32_t(100 * i), uint32_t(100 * i + 7)}});
        const ReadBricks world(place(device, objects, grids[0].frame));
        for (glm::ivec3 v{0}; v.z < size.z; ++v.z)
            for (v.y = 0; v.y < size.y; ++v.y)
                for (v.x = 0; v.x < size.x; ++v.x) {
                    const PlacedObject* winner = nullptr;
                    for (const PlacedObject& object : objects)
                        if (lumps[object.object - 10].contains(v) &&
                            (!winner || object.priority > winner->priority))
                            winner = &object;
                    ASSERT_EQ(world.is_set(v), winner != nullptr);
                    if (!winner) continue;
                    const uint32_t group = uint32_t(HostBricks::index_in_brick(v) % 3);
                    ASSERT_EQ(world.word(v), winner->material_of_group[std::min(group, 1u)] << 16 |
                                                 winner->object);
                }
    } while (std::ranges::next_permutation(order).found);
}

}  // namespace
}  // namespace voxelume
