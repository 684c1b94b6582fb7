// SPDX-License-Identifier: Apache-2.0
// The smooth half of `place`: distance fields in the world, and which object each voxel belongs to.
#include <gmock/gmock.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "runtime/base/error.hpp"
#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/place/place.hpp"
#include "tests/place/field_accuracy.hpp"
#include "tests/place/placing.hpp"
#include "tests/place/pyramid_reader.hpp"

namespace voxelume {
namespace {

BrickGrid place_one(const BrickGrid& grid, const glm::dmat4& world_from_object,
                    const GridFrame& world) {
    const std::vector<PlacedObject> objects = {
        {.grid = &grid, .world_from_object = world_from_object, .material_of_group = {0}}};
    return place(shared_device(), objects, world);
}

TEST(PlaceField, ATurnedMovedAndScaledSphereHasItsAnalyticDistances) {
    const BrickGrid sphere = sphere_bricks(2.0, 0.1).upload(shared_device());
    const glm::dvec3 centre{0.317, -0.211, 0.533};
    for (const double scale : {0.75, 1.0, 1.4, 3.0}) {
        const glm::dmat4 map = affine_from_factors(centre, {34, -21, 77}, glm::dvec3(scale));
        const int half = int(std::ceil(20 * scale)) + 11;
        const BrickGrid world = place_one(
            sphere, map,
            frame_at(glm::dvec3(-0.1 * half), glm::dvec3(0.1), {2 * half, 2 * half, 2 * half + 3}));
        const Accuracy accuracy = accuracy_of(
            world, [&](const glm::dvec3& p) { return glm::length(p - centre) - 2.0 * scale; },
            std::min(2.7, kBand * scale));
        EXPECT_LT(accuracy.near, scale < 1 ? 0.05 : 0.015) << "scale " << scale;
        EXPECT_LT(accuracy.band, 0.06) << "scale " << scale;
        EXPECT_EQ(accuracy.wrong_sides, 0) << "scale " << scale;
    }
}

TEST(PlaceField, WholeVoxelMovesTurnsAndMirrorsCopyTheDistances) {
    const glm::ivec3 size{40, 37, 43};
    const GridFrame frame = frame_at({0.7, 0.2, -0.4}, glm::dvec3(0.1), size);
    const glm::dvec3 centre{17.3, 19.1, 22.6};
    const BrickGrid grid = distance_bricks(frame, [&](const glm::ivec3& n) {
                               const glm::dvec3 p = glm::dvec3(n) - centre;
                               return banded(std::hypot(std::hypot(p.x, p.y) - 10, p.z) - 4);
                           }).upload(shared_device());
    const ReadBricks source(grid);
    const GridFrame world = frame_at({-8, -8, -8}, glm::dvec3(0.1), {161, 162, 163});
    for (const glm::dmat4& map : {affine_from_factors({0.5, -0.3, 1.1}, {0, 0, 0}, {1, 1, 1}),
                                  affine_from_factors({0.1, 0.2, 0.3}, {90, 180, 0}, {1, 1, 1}),
                                  affine_from_factors({0, 0, 0.4}, {0, 0, 90}, {1, -1, 1})}) {
        const BrickGrid placed = place_one(grid, map, world);
        const glm::dmat4 inverse = glm::inverse(map);
        int copied = 0;
        for_each_node(placed, [&](const glm::ivec3& n, double value) {
            const glm::dvec3 p = inverse * glm::dvec4(world.origin + 0.1 * glm::dvec3(n), 1);
            const glm::ivec3 m(glm::round((p - frame.origin) / 0.1));
            const bool in_grid = glm::all(glm::greaterThanEqual(m, glm::ivec3(0))) &&
                                 glm::all(glm::lessThanEqual(m, size));
            const int expected = in_grid ? source.distance_at(m) : 32767;
            copied += std::abs(expected) < 32767;
            ASSERT_EQ(value * 8192, expected);
        });
        EXPECT_GT(copied, 5000);
    }
}

TEST(PlaceField, AnUnevenlyStretchedSphereKeepsItsSurfaceAndNeverOverestimates) {
    const BrickGrid sphere = sphere_bricks(2.0, 0.1).upload(shared_device());
    const glm::dvec3 scale{1.0, 2.0, 1.3};
    const BrickGrid world =
        place_one(sphere, affine_from_factors({0, 0, 0}, {0, 0, 0}, scale),
                  frame_at({-2.53, -4.52, -3.11}, glm::dvec3(0.1), {51, 91, 63}));
    for_each_node(world, [&](const glm::ivec3& n, double placed) {
        const glm::dvec3 p = world.frame.origin + 0.1 * glm::dvec3(n);
        const double stretched = (glm::length(p / scale) - 2.0) / 0.1;
        if (std::abs(stretched) < 1.8) {
            ASSERT_NEAR(placed, stretched, 0.02);
        }
        ASSERT_TRUE((placed < 0) == (stretched < 0) || std::abs(stretched) < 0.01);
    });
}

TEST(PlaceField, WorldVoxelsLargerThanTheObjectsKeepTheRightSides) {
    const BrickGrid sphere = sphere_bricks(2.0, 0.1).upload(shared_device());
    for (const double edge : {0.11, 0.126, 0.1415}) {
        const BrickGrid world =
            place_one(sphere, affine_from_factors({0, 0, 0}, {10, 20, 30}, {1, 1, 1}),
                      frame_at(glm::dvec3(-3), glm::dvec3(edge), glm::ivec3(int(6 / edge))));
        const Accuracy accuracy =
            accuracy_of(world, [](const glm::dvec3& p) { return glm::length(p) - 2.0; });
        EXPECT_EQ(accuracy.wrong_sides, 0) << edge;
        EXPECT_GT(build_index(shared_device(), world).voxel_count, 200u) << edge;
    }
}

TEST(PlaceField, WorldVoxelsMuchSmallerThanTheObjectsFindTheSurfaceInEachOfItsCells) {
    const BrickGrid sphere = sphere_bricks(2.0, 0.1).upload(shared_device());
    for (const double scale : {5.0, 17.0, 40.0}) {
        const glm::dmat4 map = affine_from_factors({0, 0, 0}, {34, -21, 77}, glm::dvec3(scale));
        const glm::dvec3 middle = 2 * scale * glm::normalize(glm::dvec3(0.6, -0.3, 0.7));
        const GridFrame frame = frame_at(middle - 5.0, glm::dvec3(0.1), glm::ivec3(100));
        const BrickGrid world = place_one(sphere, map, frame);
        size_t near = 0, wrong = 0;
        for_each_node(world, [&](const glm::ivec3& n, double placed) {
            const glm::dvec3 p = frame.origin + 0.1 * glm::dvec3(n);
            const double truth = (glm::length(p) - 2 * scale) / 0.1;
            // The world's end closes what lies near it.
            const bool is_inner = glm::all(glm::greaterThan(n, glm::ivec3(4))) &&
                                  glm::all(glm::lessThan(n, glm::ivec3(96)));
            if (!is_inner || std::abs(truth) > 2) return;
            ++near;
            wrong += std::abs(placed - truth) > 0.25;
        });
        EXPECT_GT(near, 20'000u) << scale;
        EXPECT_EQ(wrong, 0u) << scale;
    }
}

/// The message of `place` about a sphere of voxels of 0.1 in a world of voxels of `edge`.
std::string refusal_of(const BrickGrid& sphere, const glm::dvec3& edge, const glm::dvec3& scale) {
    try {
        place_one(sphere, affine_from_factors({0, 0, 0}, {10, 20, 30}, scale),
                  frame_at(glm::dvec3(-3), edge, glm::ivec3(glm::dvec3(6) / edge)));
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::scene);
        return error.what();
    }
    return "";
}

TEST(PlaceField, AFieldWhoseBandEndsInsideAWorldVoxelIsRefused) {
    const BrickGrid sphere = sphere_bricks(2.0, 0.1).upload(shared_device());
    const glm::dvec3 one(1);
    EXPECT_EQ(refusal_of(sphere, glm::dvec3(0.1), one), "");
    EXPECT_EQ(refusal_of(sphere, glm::dvec3(0.1), glm::dvec3(-0.71)), "");
    EXPECT_EQ(refusal_of(sphere, glm::dvec3(0.05), {0.5, 1, 2}), "");
    for (const double edge : {0.15, 0.2, 0.33, 0.61})
        EXPECT_THAT(refusal_of(sphere, glm::dvec3(edge), one),
                    testing::HasSubstr("object 0: the world's voxels are"))
            << edge;
    EXPECT_THAT(refusal_of(sphere, glm::dvec3(0.1), glm::dvec3(0.5)),
                testing::HasSubstr("are 2 times as large"));
    EXPECT_THAT(refusal_of(sphere, glm::dvec3(0.1), {1, -0.5, 1}),
                testing::HasSubstr("are 2 times as large"));
    EXPECT_THAT(refusal_of(sphere, {0.1, 0.1, 0.2}, one),
                testing::HasSubstr("are 2 times as large"));
}

TEST(PlaceField, APartOfTheWorldsLatticeIsCopied) {
    const GridFrame world = frame_at({-3, -2, -4}, {0.1, 0.15, 0.2}, {60, 50, 45});
    GridFrame part = world;
    part.origin = world.origin - glm::dvec3(16, 0, -16) * world.voxel_edge;
    part.size = {64, 48, 32};
    const BrickGrid grid = distance_bricks(part, [&](const glm::ivec3& n) {
                               const glm::dvec3 p = part.origin + part.voxel_edge * glm::dvec3(n);
                               return banded((glm::length(p - glm::dvec3(-2.5, 0.3, 1)) - 1) / 0.1);
                           }).upload(shared_device());
    const ReadBricks source(grid);
    int copied = 0;
    for_each_node(place_one(grid, glm::dmat4(1), world), [&](const glm::ivec3& n, double value) {
        const glm::ivec3 m = n + glm::ivec3(16, 0, -16);
        const bool in_grid = glm::all(glm::greaterThanEqual(m, glm::ivec3(0))) &&
                             glm::all(glm::lessThanEqual(m, part.size));
        const int expected = in_grid ? source.distance_at(m) : 32767;
        copied += std::abs(expected) < 32767;
        // The world's end closes what lies near it.
        if (n.x >= 4) {
            ASSERT_EQ(value * 8192, expected);
        }
    });
    EXPECT_GT(copied, 1500);
}

TEST(PlaceField, TakesTheGroupOfTheCellThatTheSurfaceCrosses) {
    // Group 1 is above the sphere's equator, group 0 below. Only voxels that the surface passes
    // have attributes.
    const Device& device = shared_device();
    HostBricks bricks = sphere_bricks(2.0, 0.1);
    bricks.attributes.assign(bricks.distance.size(), 2u << 16);
    const glm::ivec3 size = bricks.frame.size;
    for (glm::ivec3 v{0}; v.z < size.z; ++v.z)
        for (v.y = 0; v.y < size.y; ++v.y)
            for (v.x = 0; v.x < size.x; ++v.x) {
                const glm::dvec3 low = bricks.frame.origin + 0.1 * glm::dvec3(v);
                const glm::dvec3 closest = glm::clamp(glm::dvec3(0), low, low + 0.1);
                const glm::dvec3 farthest = glm::max(glm::abs(low), glm::abs(low + 0.1));
                if (glm::length(closest) <= 2.0 && glm::length(farthest) >= 2.0)
                    bricks.attributes[bricks.index_of(v)] = uint32_t(low.y > -0.05) << 16;
            }
    const BrickGrid grid = bricks.upload(device);
    const std::vector<PlacedObject> objects = {
        {.grid = &grid,
         .world_from_object = affine_from_factors({0.03, 0.04, 0.01}, {25, 0, 0}, {1, 1, 1}),
         .object = 3,
         .material_of_group = {7, 8, 9}}};
    const GridFrame frame = frame_at(glm::dvec3(-3), glm::dvec3(0.1), {60, 61, 62});
    const BrickGrid world = place(device, objects, frame);
    const HostPyramid host(build_index(device, world));
    int shown = 0;
    for (glm::ivec3 v{0}; v.z < frame.size.z; ++v.z)
        for (v.y = 0; v.y < frame.size.y; ++v.y)
            for (v.x = 0; v.x < frame.size.x; ++v.x) {
                int log2 = 0;
                const auto voxel = host.find(v, log2);
                const double y = frame.origin.y + 0.1 * (v.y + 0.5) - 0.04;
                if (!voxel || std::abs(y) < 0.2) continue;
                ++shown;
                ASSERT_EQ(host.word(*voxel), 0x40000003u | (y > 0 ? 8u : 7u) << 16);
            }
    EXPECT_GT(shown, 5000);
}

TEST(PlaceField, OneAttributeForAllNeedsNoList) {
    const Device& device = shared_device();
    const BrickGrid sphere = sphere_bricks(1.0, 0.1).upload(device);
    const std::vector<PlacedObject> objects = {
        {.grid = &sphere, .object = 9, .material_of_group = {4}}};
    const BrickGrid world =
        place(device, objects, frame_at(glm::dvec3(-2), glm::dvec3(0.1), {40, 40, 41}));
    EXPECT_TRUE(world.attributes.empty());
    EXPECT_EQ(world.attribute, 0x40040009u);
    EXPECT_TRUE(world.occupancy.empty());
    EXPECT_EQ(build_index(device, world).attribute, 0x40040009u);
}

}  // namespace
}  // namespace voxelume
