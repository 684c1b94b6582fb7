// SPDX-License-Identifier: Apache-2.0
// The exact half of `place`: primitive lists of several objects joined in the world.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/shared/solid.h"
#include "runtime/base/error.hpp"
#include "runtime/stages/place/place.hpp"
#include "tests/support/brick_grids.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Voxels with lists, given in the brick's order.
BrickGrid exact_grid(const Device& device, const GridFrame& frame,
                     const std::map<glm::ivec3, std::vector<uint32_t>, VoxelOrder>& lists,
                     size_t triangles) {
    VoxelMap voxels;
    for (const auto& [v, list] : lists) voxels[v] = 0;
    HostBricks bricks = occupied_bricks(frame, voxels);
    bricks.attributes.clear();
    std::vector<std::vector<uint32_t>> by_index(bricks.coordinates.size() * 4096);
    for (const auto& [v, list] : lists) by_index[bricks.index_of(v)] = list;
    std::vector<uint32_t> first = {0}, primitives;
    for (const std::vector<uint32_t>& list : by_index) {
        primitives.insert(primitives.end(), list.begin(), list.end());
        first.push_back(uint32_t(primitives.size()));
    }
    BrickGrid grid = bricks.upload(device);
    grid.primitive_first = {device, "first", first};
    grid.primitives = {device, "primitives", primitives};
    std::vector<float> corners(triangles * 9);
    for (size_t i = 0; i < corners.size(); ++i) corners[i] = float(i) + 0.25f * float(triangles);
    grid.triangles = {device, "triangles", corners};
    return grid;
}

std::vector<uint32_t> list_of(const BrickGrid& world, const glm::ivec3& v) {
    const size_t index = ReadBricks(world).host.index_of(v);
    const std::vector<uint32_t> first = world.primitive_first.read(index, 2);
    return world.primitives.read(first[0], first[1] - first[0]);
}

TEST(PlaceExact, JoinsListsInTheOrderOfObjectsWithNewNumbersAndWords) {
    const Device device = test_device();
    const GridFrame frame = frame_of({37, 20, 9});
    BrickGrid a =
        exact_grid(device, frame, {{{3, 2, 1}, {0, 1, kSolidPrimitive}}, {{20, 5, 7}, {1}}}, 2);
    a.triangle_attributes = {device, "words", std::vector<uint32_t>{1u << 16, 0}};
    SolidShape shape = {};
    shape.attribute = 1u << 16;
    shape.shape_count = 1;
    const auto* words = reinterpret_cast<const uint32_t*>(&shape);
    a.solids = {device, "solids", std::span(words, VXL_SOLID_WORDS)};
    BrickGrid b =
        exact_grid(device, frame, {{{3, 2, 1}, {2, kSolidPrimitive}}, {{2, 18, 8}, {0}}}, 3);
    b.solids = a.solids;
    const std::vector<PlacedObject> objects = {
        {.grid = &a, .object = 5, .material_of_group = {10, 11}, .in_world_frame = true},
        {.grid = &b,
         .object = 6,
         .priority = 1,
         .material_of_group = {20, 21},
         .in_world_frame = true}};
    const BrickGrid world = place(device, objects, frame);
    EXPECT_THAT(list_of(world, {3, 2, 1}),
                ElementsAre(0u, 1u, kSolidPrimitive, 4u, kSolidPrimitive + 1));
    EXPECT_THAT(list_of(world, {20, 5, 7}), ElementsAre(1u));
    EXPECT_THAT(list_of(world, {2, 18, 8}), ElementsAre(2u));
    EXPECT_THAT(list_of(world, {2, 2, 1}), ElementsAre());
    const uint32_t exact = 2u << 30;
    EXPECT_THAT(world.triangle_attributes.read(),
                ElementsAre(exact | 11u << 16 | 5, exact | 10u << 16 | 5, exact | 20u << 16 | 6,
                            exact | 20u << 16 | 6, exact | 20u << 16 | 6));
    std::vector<float> corners = a.triangles.read();
    const std::vector<float> more = b.triangles.read();
    corners.insert(corners.end(), more.begin(), more.end());
    EXPECT_EQ(world.triangles.read(), corners);
    const std::vector<uint32_t> solids = world.solids.read();
    EXPECT_EQ(solids.at(3), exact | 11u << 16 | 5);
    EXPECT_EQ(solids.at(VXL_SOLID_WORDS + 3), exact | 21u << 16 | 6);
    const ReadBricks read(world);
    EXPECT_EQ(read.word({3, 2, 1}), exact | 20u << 16 | 6) << "the higher priority";
    EXPECT_EQ(read.word({20, 5, 7}), exact | 10u << 16 | 5);
    EXPECT_EQ(read.voxels().size(), 3u);
}

TEST(PlaceExact, CubesHideExactSurfacesOrStandBehindThemAsPrioritiesSay) {
    const Device device = test_device();
    const GridFrame frame = frame_of({7, 5, 3});
    const BrickGrid exact = exact_grid(device, frame, {{{3, 2, 1}, {0}}, {{5, 4, 2}, {0}}}, 1);
    const BrickGrid cubes = occupied_bricks(frame, {{{3, 2, 1}, 0}, {{2, 2, 1}, 0}}).upload(device);
    for (const int priority : {-1, 0, 1})
        for (const bool exact_first : {true, false}) {
            std::vector<PlacedObject> objects = {
                {.grid = &exact, .object = 1, .priority = priority, .in_world_frame = true},
                {.grid = &cubes, .object = 2, .in_world_frame = true}};
            if (!exact_first) std::swap(objects[0], objects[1]);
            const ReadBricks read(place(device, objects, frame));
            const bool exact_wins = priority > 0 || (priority == 0 && exact_first);
            EXPECT_EQ(read.word({3, 2, 1}), exact_wins ? 3u << 30 | 2 : 2u)
                << priority << exact_first;
            EXPECT_EQ(read.word({2, 2, 1}), 2u);
            EXPECT_EQ(read.word({5, 4, 2}), 2u << 30 | 1);
        }
}

TEST(PlaceExact, CubesWithColorsMakeWayForExactSurfaces) {
    const Device device = test_device();
    const GridFrame frame = frame_of({7, 5, 3});
    const BrickGrid exact = exact_grid(device, frame, {{{3, 2, 1}, {0}}}, 1);
    HostBricks bricks = occupied_bricks(frame, {{{3, 2, 1}, 0}, {{2, 2, 1}, 0}});
    bricks.colors.assign(bricks.attributes.size(), 0x203040);
    const BrickGrid cubes = bricks.upload(device);
    const std::vector<PlacedObject> objects = {
        {.grid = &exact, .object = 1, .in_world_frame = true},
        {.grid = &cubes, .object = 2, .in_world_frame = true}};
    const ReadBricks read(place(device, objects, frame));
    EXPECT_EQ(read.word({3, 2, 1}), 2u << 30 | 1);
    EXPECT_EQ(read.word({2, 2, 1}), 2u);
}

TEST(PlaceExact, RefusesToResampleAndForeignFrames) {
    const Device device = test_device();
    const GridFrame frame = frame_of({7, 5, 3});
    const BrickGrid grid = exact_grid(device, frame, {{{3, 2, 1}, {0}}}, 1);
    const auto message_of = [&](bool in_world_frame, const GridFrame& world) -> std::string {
        const std::vector<PlacedObject> objects = {
            {.grid = &grid, .object = 4, .in_world_frame = in_world_frame}};
        try {
            place(device, objects, world);
        } catch (const Error& error) {
            return error.what();
        }
        return "placed";
    };
    EXPECT_THAT(message_of(false, frame), HasSubstr("object 4: an exact surface can't be"));
    EXPECT_THAT(message_of(true, frame_of({7, 5, 4})), HasSubstr("another frame"));
    EXPECT_EQ(message_of(true, frame), "placed");
}

}  // namespace
}  // namespace voxelume
