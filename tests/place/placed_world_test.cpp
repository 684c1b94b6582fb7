// SPDX-License-Identifier: Apache-2.0
// Worlds of several objects: whose surface is in which voxel, against the objects' formulas.
#include <gtest/gtest.h>

#include <set>

#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/place/placed_world.hpp"
#include "runtime/stages/voxelize/voxelize_solid.hpp"
#include "tests/place/field_accuracy.hpp"
#include "tests/place/placing.hpp"
#include "tests/place/pyramid_reader.hpp"

namespace voxelume {
namespace {

constexpr double kVoxelEdge = 0.1, kRadius = 2.0;

Pyramid pyramid_of(const std::vector<PlacedObject>& objects, const GridFrame& frame) {
    const Device& device = shared_device();
    return Indexer(device).index(place_world(device, objects, frame), nullptr);
}

std::vector<PlacedObject> spheres_at(const BrickGrid& sphere,
                                     std::initializer_list<glm::dvec3> centres) {
    std::vector<PlacedObject> objects;
    for (const glm::dvec3& centre : centres)
        objects.push_back(
            {.grid = &sphere,
             .world_from_object = affine_from_factors(centre, {10, 20, 30}, {1, 1, 1}),
             .object = uint32_t(objects.size()),
             .material_of_group = {5 + uint32_t(objects.size())}});
    return objects;
}

/// The minimum and maximum distance of a voxel's points from a point, in metres.
glm::dvec2 distances_of(const glm::dvec3& low, const glm::dvec3& centre) {
    const glm::dvec3 closest = glm::clamp(centre, low, low + kVoxelEdge);
    const glm::dvec3 away = glm::max(glm::abs(low - centre), glm::abs(low + kVoxelEdge - centre));
    return {glm::length(closest - centre), glm::length(away)};
}

TEST(PlacedWorld, KeepsTheFieldOfEachObject) {
    const BrickGrid sphere = sphere_bricks(kRadius, kVoxelEdge).upload(shared_device());
    const std::array centres = {glm::dvec3{-1.23, 0.1, 0}, glm::dvec3{1.31, 0, 0.17}};
    const GridFrame frame = frame_at({-4, -3, -3}, glm::dvec3(kVoxelEdge), {80, 60, 61});
    const PlacedWorld world =
        place_world(shared_device(), spheres_at(sphere, {centres[0], centres[1]}), frame);
    ASSERT_EQ(world.fields.size(), 2u);
    EXPECT_EQ(world.voxels.brick_count, 0u);
    for (const PlacedField& field : world.fields) {
        const Accuracy accuracy = accuracy_of(field.grid, [&](const glm::dvec3& p) {
            return glm::length(p - centres[field.object]) - kRadius;
        });
        EXPECT_LT(accuracy.near, 0.02);
        EXPECT_EQ(accuracy.wrong_sides, 0);
    }
}

// Three spheres pass through each other: every voxel holds the fields of the spheres whose surfaces
// pass it, and of others only where a surface is within a hundredth of a voxel.
TEST(PlacedWorld, VoxelsListTheSurfacesThatPassThem) {
    const BrickGrid sphere = sphere_bricks(kRadius, kVoxelEdge).upload(shared_device());
    const std::array centres = {glm::dvec3{-1.23, 0.1, 0}, glm::dvec3{1.31, 0, 0.17},
                                glm::dvec3{0.1, 1.1, 0.4}};
    const GridFrame frame = frame_at({-4, -3, -3}, glm::dvec3(kVoxelEdge), {80, 70, 61});
    std::vector<PlacedObject> objects = spheres_at(sphere, {centres[0], centres[1], centres[2]});
    const Pyramid pyramid = pyramid_of(objects, frame);
    const HostPyramid host(pyramid);
    std::set<uint32_t> records;
    size_t listed = 0, beyond = 0;
    for (glm::ivec3 v{0}; v.z < frame.size.z; ++v.z)
        for (v.y = 0; v.y < frame.size.y; ++v.y)
            for (v.x = 0; v.x < frame.size.x; ++v.x) {
                int log2 = 0;
                const auto voxel = host.find(v, log2);
                std::set<uint32_t> held;
                if (voxel)
                    for (const uint32_t record : host.fields_in(*voxel)) {
                        const uint32_t object = host.word(record) & 0xFFFFu;
                        ASSERT_EQ(host.word(record), 0x40000000u | (5 + object) << 16 | object);
                        ASSERT_TRUE(held.insert(object).second) << "listed twice";
                        ASSERT_TRUE(records.insert(record).second) << "of two voxels";
                    }
                listed += held.size() > 1 ? held.size() : 0;
                const glm::dvec3 low = frame.origin + kVoxelEdge * glm::dvec3(v);
                for (uint32_t i = 0; i < 3; ++i) {
                    const glm::dvec2 d = distances_of(low, centres[i]);
                    const double slack = 0.02 * kVoxelEdge;
                    if (d.x < kRadius - slack && d.y > kRadius + slack)
                        ASSERT_TRUE(held.contains(i))
                            << v.x << " " << v.y << " " << v.z << " of " << i;
                    else if (d.x > kRadius + slack || d.y < kRadius - slack)
                        beyond += held.contains(i);
                }
            }
    EXPECT_EQ(listed, pyramid.listed_fields);
    EXPECT_EQ(
        records.size() + 0u, size_t(pyramid.records()) - [&] {
            size_t lists = 0;
            for (uint32_t v = 0; v < pyramid.voxel_count; ++v) lists += host.word(v) >> 30 == 2;
            return lists;
        }());
    EXPECT_GT(listed, 1000u);
    // The bound that keeps cells is not exact.
    EXPECT_LT(beyond, records.size() / 20);

    std::ranges::reverse(objects);
    const Pyramid other = pyramid_of(objects, frame);
    EXPECT_EQ(other.voxel_count, pyramid.voxel_count);
    EXPECT_EQ(other.leaves.read(), pyramid.leaves.read());
    EXPECT_EQ(other.listed_fields, pyramid.listed_fields);
}

TEST(PlacedWorld, CubesHideFieldsOrStandBehindThemAsPrioritiesSay) {
    const Device& device = shared_device();
    const BrickGrid sphere = sphere_bricks(1.0, kVoxelEdge).upload(device);
    VoxelMap slab;
    for (int z = 0; z < 31; ++z)
        for (int x = 0; x < 30; ++x) slab[{x, 15, z}] = 0;
    HostBricks bricks =
        occupied_bricks(frame_at(glm::dvec3(-1.5), glm::dvec3(kVoxelEdge), {30, 32, 31}), slab);
    bricks.attributes.clear();
    const BrickGrid cubes = bricks.upload(device);
    for (const int priority : {-1, 1}) {
        const std::vector<PlacedObject> objects = {
            {.grid = &cubes, .object = 1, .material_of_group = {10}, .in_world_frame = true},
            {.grid = &sphere, .object = 2, .priority = priority, .material_of_group = {20}}};
        const HostPyramid host(pyramid_of(objects, cubes.frame));
        int log2 = 0;
        // The sphere's surface passes through (25,15,15); (2,15,2) is far outside of it.
        const uint32_t shared = host.find({25, 15, 15}, log2).value();
        EXPECT_EQ(host.word(shared), priority > 0 ? 0xC00A0001u : 0x000A0001u);
        const std::vector<uint32_t> fields = host.fields_in(shared);
        ASSERT_EQ(fields.size(), priority > 0 ? 1u : 0u);
        for (const uint32_t field : fields) EXPECT_EQ(host.word(field), 0x40140002u);
        EXPECT_EQ(host.word(host.find({2, 15, 2}, log2).value()), 0x000A0001u);
        EXPECT_EQ(host.word(host.find({15, 25, 15}, log2).value()), 0x40140002u);
    }
}

TEST(PlacedWorld, AnExactVoxelListsTheFieldsInIt) {
    const Device& device = shared_device();
    const BrickGrid sphere = sphere_bricks(1.0, kVoxelEdge).upload(device);
    const GridFrame frame = frame_at(glm::dvec3(-1.5), glm::dvec3(kVoxelEdge), {30, 32, 31});
    Solid box;
    box.kind = SolidKind::box;
    box.size = {2.6, 0.4, 2.6};
    const BrickGrid exact =
        voxelize_solid(device, box, glm::dmat4(1), frame, {Surface::exact, VoxelSet::supercover});
    const std::vector<PlacedObject> objects = {
        {.grid = &sphere, .object = 0, .material_of_group = {1}},
        {.grid = &exact, .object = 1, .material_of_group = {2}, .in_world_frame = true}};
    const Pyramid pyramid = pyramid_of(objects, frame);
    const HostPyramid host(pyramid);
    const std::vector<uint32_t> first = pyramid.primitive_first.read();
    size_t both = 0;
    for (uint32_t voxel = 0; voxel < pyramid.voxel_count; ++voxel) {
        const uint32_t kind = host.word(voxel) >> 30;
        const uint32_t primitives = first[voxel + 1] - first[voxel];
        ASSERT_EQ(primitives > 0, kind == 2) << "of voxel " << voxel;
        const std::vector<uint32_t> fields = host.fields_in(voxel);
        for (const uint32_t field : fields) ASSERT_EQ(host.word(field), 0x40010000u);
        both += primitives > 0 && !fields.empty();
    }
    EXPECT_EQ(both, pyramid.listed_fields);
    EXPECT_GT(both, 100u);
}

}  // namespace
}  // namespace voxelume
