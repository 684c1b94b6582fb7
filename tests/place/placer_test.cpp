// SPDX-License-Identifier: Apache-2.0
// Placing only what changed, against placing everything.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "tests/place/follower.hpp"

namespace voxelume {
namespace {

TEST(Placer, FollowsRandomChanges) {
    constexpr uint32_t kSeed = 7;
    std::mt19937 random(kSeed);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const BrickGrid smooth = ball(0.3, Surface::smooth), small = ball(0.1, Surface::smooth);
    const BrickGrid cubes = ball(0.25, Surface::cubes),
                    shell = ball(0.4, Surface::cubes, VoxelSet::supercover);
    const std::array grids = {&smooth, &small, &cubes, &shell};
    const GridFrame frame = world_of(100);
    const auto somewhere = [&](uint32_t number) {
        PlacedObject object = at(*grids[random() % grids.size()], number,
                                 {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
        const glm::dvec3 axis(uniform(-1, 1), uniform(-1, 1), 0.3);
        object.world_from_object = glm::rotate(object.world_from_object, uniform(0, 6), axis);
        object.priority = int(random() % 2);
        object.keeps_inside = object.grid == &cubes && random() % 2;
        return object;
    };
    std::vector<PlacedObject> objects;
    for (uint32_t number = 0; number < 6; ++number) objects.push_back(somewhere(number));
    Follower follower;
    expect_as_placed_afresh(follower, objects, frame, "at first");
    for (int step = 0; step < 25; ++step) {
        const size_t which = random() % objects.size();
        const auto kind = random() % 4;
        if (kind == 0 && objects.size() > 3)
            objects.erase(objects.begin() + long(which));
        else if (kind == 1)
            objects.push_back(somewhere(objects.back().object + 1));
        else
            objects[which] = somewhere(objects[which].object);
        expect_as_placed_afresh(follower, objects, frame,
                                fmt::format("seed {}, step {}", kSeed, step));
    }
}

TEST(Placer, PaintsNothingWhereNothingChanged) {
    const BrickGrid grid = ball(0.3, Surface::smooth);
    const std::vector<PlacedObject> objects = {at(grid, 0, {-.5, 0, 0}), at(grid, 1, {.5, 0, 0})};
    WorldPlacer placer(shared_device());
    const uint32_t bricks = bricks_of(placer.place(objects, world_of(100)));
    EXPECT_EQ(placer.painted_bricks(), bricks);
    DeviceCounters& counters = shared_device().counters();
    counters.launches.clear();
    EXPECT_EQ(bricks_of(placer.place(objects, world_of(100))), bricks);
    EXPECT_EQ(placer.painted_bricks(), 0u);
    EXPECT_TRUE(counters.launches.empty());
}

TEST(Placer, PaintsTheBricksOfAMovedObjectOnly) {
    const BrickGrid grid = ball(0.2, Surface::smooth);
    std::vector<PlacedObject> objects = {at(grid, 0, {-.6, 0, 0}), at(grid, 1, {.6, 0, 0})};
    WorldPlacer placer(shared_device());
    DeviceCounters& counters = shared_device().counters();
    counters.launches.clear();
    placer.place(objects, world_of(100));
    EXPECT_EQ(counters.launches.at("mark_near_leaves"), 1u) << "both have the same grid";
    const std::vector<PlacedObject> alone = {objects[0]};
    const uint32_t of_one = place(shared_device(), alone, world_of(100)).brick_count;
    objects[0].world_from_object[3].x += kEdge;
    placer.place(objects, world_of(100));
    EXPECT_GE(placer.painted_bricks(), of_one / 2);
    EXPECT_LE(placer.painted_bricks(), of_one * 3 / 2);
}

TEST(Indexer, LaunchesNothingWhereNothingChanged) {
    const BrickGrid grid = ball(0.2, Surface::smooth);
    std::vector<PlacedObject> objects = {at(grid, 0, {-.6, 0, 0}), at(grid, 1, {.6, 0, 0})};
    Follower follower;
    follower.pyramid_of(objects, world_of(100));
    std::map<std::string, uint64_t>& launches = shared_device().counters().launches;
    launches.clear();
    follower.pyramid_of(objects, world_of(100));
    EXPECT_TRUE(launches.empty());
    objects[0].world_from_object[3].x += kEdge;
    follower.pyramid_of(objects, world_of(100));
    EXPECT_EQ(launches.at("mark_voxels"), 1u) << "of the one that moved";
}

TEST(Placer, GrowsAndShrinksWithItsObjects) {
    const BrickGrid grid = ball(0.2, Surface::cubes);
    std::vector<PlacedObject> objects = {at(grid, 0, {-.6, -.6, -.6})};
    Follower follower;
    for (uint32_t number = 1; number < 8; ++number) {
        objects.push_back(at(
            grid, number, {number & 1 ? .6 : -.6, number & 2 ? .6 : -.6, number & 4 ? .6 : -.6}));
        expect_as_placed_afresh(follower, objects, world_of(100),
                                fmt::format("{} objects", number));
    }
    while (objects.size() > 1) {
        objects.erase(objects.begin());
        expect_as_placed_afresh(follower, objects, world_of(100),
                                fmt::format("{} left", objects.size()));
    }
    expect_as_placed_afresh(follower, {}, world_of(100), "none left");
}

TEST(Placer, TakesAnotherFrameAndOtherKinds) {
    const BrickGrid cubes = ball(0.2, Surface::cubes), smooth = ball(0.2, Surface::smooth);
    Follower follower;
    const std::vector<PlacedObject> first = {at(cubes, 0, {0, 0, 0}), at(cubes, 1, {.3, 0, 0})};
    const std::vector<PlacedObject> second = {at(smooth, 0, {0, 0, 0}), at(cubes, 1, {.3, 0, 0})};
    expect_as_placed_afresh(follower, first, world_of(100), "cubes");
    expect_as_placed_afresh(follower, second, world_of(100), "smooth and cubes");
    expect_as_placed_afresh(follower, second, world_of(80), "a smaller world");
    expect_as_placed_afresh(follower, first, world_of(80), "cubes again");
}

TEST(Placer, JoinsExactObjectsAgain) {
    Solid solid;
    solid.radius = 0.3;
    const GridFrame frame = world_of(100);
    const auto exact_at = [&](double x) {
        return voxelize_solid(shared_device(), solid,
                              glm::translate(glm::dmat4(1), glm::dvec3(x, 0, 0)), frame,
                              {Surface::exact, VoxelSet::supercover});
    };
    const BrickGrid left = exact_at(-.4), right = exact_at(.35), cubes = ball(.25, Surface::cubes);
    std::vector<PlacedObject> objects = {at(left, 0, {0, 0, 0}), at(cubes, 1, {0, .3, 0})};
    objects[0].in_world_frame = true;
    Follower follower;
    expect_as_placed_afresh(follower, objects, frame, "at first");
    objects[0].grid = &right;
    expect_as_placed_afresh(follower, objects, frame, "moved");
    objects[1].world_from_object[3].y = -.4;
    expect_as_placed_afresh(follower, objects, frame, "the cubes moved");
}

// Bricks that an exact object neither left nor reached keep their marks, even where its lists
// change.
TEST(Placer, FollowsRandomChangesOfExactObjects) {
    constexpr uint32_t kSeed = 19;
    std::mt19937 random(kSeed);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const GridFrame frame = world_of(100);
    const BrickGrid smooth = ball(0.3, Surface::smooth), cubes = ball(0.25, Surface::cubes);
    std::vector<BrickGrid> exact;
    for (int i = 0; i < 6; ++i) {
        Solid solid;
        solid.radius = uniform(0.1, 0.4);
        const glm::dvec3 place(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        exact.push_back(voxelize_solid(shared_device(), solid, glm::translate(glm::dmat4(1), place),
                                       frame, {Surface::exact, VoxelSet::supercover}));
    }
    const auto something = [&](uint32_t number) {
        const size_t kind = random() % (exact.size() + 2);
        if (kind >= exact.size())
            return at(kind == exact.size() ? smooth : cubes, number,
                      {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
        PlacedObject object = at(exact[kind], number, {0, 0, 0});
        object.in_world_frame = true;
        return object;
    };
    // One object of each kind stays, so that bricks are stored alike throughout.
    std::vector<PlacedObject> objects = {at(exact[0], 0, {0, 0, 0}), at(smooth, 1, {.3, 0, 0}),
                                         at(cubes, 2, {-.4, .2, 0})};
    objects[0].in_world_frame = true;
    for (uint32_t number = 3; number < 6; ++number) objects.push_back(something(number));
    Follower follower;
    for (int step = 0; step < 25; ++step) {
        expect_as_placed_afresh(follower, objects, frame,
                                fmt::format("seed {}, step {}", kSeed, step));
        const size_t which = 3 + random() % (objects.size() - 3);
        objects[which] = something(objects[which].object);
    }
}

/// A block of cubes with a different colour for each voxel.
BrickGrid colored_block() {
    const GridFrame frame = frame_at(glm::dvec3(0), glm::dvec3(kEdge), glm::ivec3(9, 7, 5));
    VoxelMap voxels;
    for (int i = 0; i < 9 * 7 * 5; ++i) voxels[{i % 9, i / 9 % 7, i / 63}] = 0;
    HostBricks bricks = occupied_bricks(frame, voxels);
    bricks.attributes.clear();
    bricks.colors.resize(bricks.coordinates.size() * 4096);
    for (uint32_t i = 0; i < bricks.colors.size(); ++i) bricks.colors[i] = i * 40503u & 0xFFFFFF;
    return bricks.upload(shared_device());
}

// Objects of every kind come and go. They are so few that each is often the only one of its kind,
// or the only one.
TEST(Placer, FollowsObjectsThatComeAndGoAsTheOnlyOnesOfTheirKind) {
    constexpr uint32_t kSeed = 11;
    std::mt19937 random(kSeed);
    const GridFrame frame = world_of(100);
    Solid solid;
    solid.radius = 0.3;
    const BrickGrid smooth = ball(0.3, Surface::smooth), cubes = ball(0.25, Surface::cubes);
    const BrickGrid colored = colored_block();
    const BrickGrid exact = voxelize_solid(shared_device(), solid,
                                           glm::translate(glm::dmat4(1), glm::dvec3(-.4, .3, 0)),
                                           frame, {Surface::exact, VoxelSet::supercover});
    std::vector<PlacedObject> all = {at(smooth, 0, {.5, 0, 0}), at(cubes, 1, {-.5, -.4, .3}),
                                     at(colored, 2, {.4, .1, .2}), at(exact, 3, {0, 0, 0}),
                                     at(smooth, 4, {-.3, 0, .1})};
    all[3].in_world_frame = true;
    Follower follower;
    uint32_t shown = 0b00101;
    for (int step = 0; step < 40; ++step) {
        std::vector<PlacedObject> objects;
        for (size_t i = 0; i < all.size(); ++i)
            if (shown >> i & 1) objects.push_back(all[i]);
        expect_as_placed_afresh(follower, objects, frame,
                                fmt::format("seed {}, step {}, objects {:b}", kSeed, step, shown));
        shown ^= 1u << random() % all.size();
        if (random() % 4 == 0) shown = uint32_t(random()) & 31u;
    }
}

TEST(Placer, PaintsOnlyItsOwnBricksWhenAnObjectComesOrGoes) {
    const BrickGrid smooth = ball(0.2, Surface::smooth), cubes = ball(0.2, Surface::cubes);
    const std::vector<PlacedObject> two = {at(smooth, 0, {-.6, 0, 0}), at(cubes, 1, {.6, 0, 0})};
    std::vector<PlacedObject> three = two;
    three.push_back(at(smooth, 2, {0, .1, 0}));
    const GridFrame frame = world_of(100);
    WorldPlacer placer(shared_device());
    const uint32_t of_two = bricks_of(placer.place(two, frame));
    const uint32_t of_three = bricks_of(placer.place(three, frame));
    EXPECT_EQ(placer.painted_bricks(), of_three - of_two);
    EXPECT_EQ(bricks_of(placer.place(two, frame)), of_two);
    EXPECT_EQ(placer.painted_bricks(), 0u);
    placer.place({three.data() + 2, 1}, frame);
    EXPECT_TRUE(placer.place({two.data(), 1}, frame).voxels.occupancy.empty());
}

TEST(Placer, StartsAfreshAfterAnError) {
    const BrickGrid grid = ball(0.2, Surface::smooth);
    std::vector<PlacedObject> objects = {at(grid, 0, {0, 0, 0}), at(grid, 1, {.3, 0, 0})};
    Follower follower;
    follower.placer.place(objects, world_of(100));
    const glm::dmat4 before = objects[1].world_from_object;
    objects[1].world_from_object[0][0] = 0;
    EXPECT_ANY_THROW(follower.placer.place(objects, world_of(100)));
    objects[1].world_from_object = before;
    expect_as_placed_afresh(follower, objects, world_of(100), "after an error");
}

}  // namespace
}  // namespace voxelume
