// SPDX-License-Identifier: Apache-2.0
// Memory plans against what worlds and images take, and which scenes are refused.
#include "runtime/memory/plan.hpp"

#include <gmock/gmock.h>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/render/renderer.hpp"
#include "tests/memory/plan_fixture.hpp"
#include "tests/support/test_device.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {

TEST_F(PlanTest, EstimatesAreWithinAHalfOfWhatFormingTheWorldTakes) {
    for (const char* model :
         {R"({"shape": "sphere", "radius": 0.35, "surface": "smooth"})",
          R"({"shape": "box", "size": [0.803,0.302,0.507], "surface": "cubes"})",
          R"({"shape": "torus", "radius": 0.3, "tube": 0.09, "surface": "smooth"})",
          R"({"shape": "ellipsoid", "radii": [0.3, 0.2, 0.25], "surface": "exact"})"}) {
        const Scene scene = scene_of(model, 1.0 / 200);
        const ScenePlan plan = plan_of(scene);
        const Device device = test_device();
        WorldReport report;
        const Pyramid world = build_world(device, scene, report);
        const double voxels = world.voxel_count;
        EXPECT_GT(plan.voxels, voxels / 1.5) << model;
        EXPECT_LT(plan.voxels, voxels * 1.5) << model;
        const double built = std::max({plan.voxelize_bytes, plan.place_bytes, plan.index_bytes});
        const auto peak = double(device.counters().peak_bytes);
        EXPECT_GT(built, peak / 1.5) << model;
        EXPECT_LT(built, peak * 1.5) << model;
        BufferPlan planned = plan.largest;
        for (const GridPlan& grid : plan.grids) keep_larger(planned, grid.largest);
        uint64_t largest = 0;
        for (const auto& [name, bytes] : device.counters().allocated_bytes)
            largest = std::max(largest, bytes);
        EXPECT_GT(planned.bytes, double(largest) / 2) << model << ": " << planned.name;
        EXPECT_LT(planned.bytes, double(largest) * 1.5) << model << ": " << planned.name;
    }
}

TEST_F(PlanTest, ObjectsInEachOthersBricksPlanNoLargerBuffersThanAreMade) {
    for (const char* surface : {"smooth", "cubes", "exact"}) {
        Scene scene = scene_of(
            fmt::format(R"({{"shape": "sphere", "radius": 0.03, "surface": "{}"}})", surface),
            1.0 / 200);
        const Object ball = scene.objects[0];
        for (int i = 1; i < 60; ++i) {
            const glm::dvec3 step = {0.07 * (i % 4), 0.05 * (i / 4 % 5), 0.06 * (i / 20)};
            scene.objects.push_back(ball);
            scene.objects.back().world_from_object =
                glm::translate(glm::dmat4(1), step) * ball.world_from_object;
        }
        const ScenePlan plan = plan_of(scene);
        const Device device = test_device();
        WorldReport report;
        build_world(device, scene, report);
        uint64_t largest = 0;
        for (const auto& [name, bytes] : device.counters().allocated_bytes)
            if (name.starts_with("world")) largest = std::max(largest, bytes);
        EXPECT_GT(plan.largest.bytes, 0) << surface;
        EXPECT_LE(plan.largest.bytes, double(largest)) << surface << ": " << plan.largest.name;
        EXPECT_LT(plan.min_bytes, plan.peak_bytes()) << surface;
        EXPECT_LT(plan.min_bytes, double(device.counters().peak_bytes)) << surface;
        DeviceInfo info = device.info();
        info.max_allocation = largest;
        info.memory = device.counters().peak_bytes * 3 / 2;
        EXPECT_NO_THROW(check_memory(scene, plan, info)) << surface;
    }
}

TEST_F(PlanTest, ObjectsApartAreAllRefusedWithTheirMemory) {
    Scene scene =
        scene_of(R"({"shape": "box", "size": [0.1, 0.1, 0.1], "surface": "smooth"})", 1.0 / 200);
    const Object ball = scene.objects[0];
    for (const glm::dvec3 step : {glm::dvec3(0.25, 0, 0), glm::dvec3(-0.25, 0, 0),
                                  glm::dvec3(0, 0.25, 0), glm::dvec3(0, 0, -0.25)}) {
        scene.objects.push_back(ball);
        scene.objects.back().world_from_object =
            glm::translate(glm::dmat4(1), step) * ball.world_from_object;
    }
    const ScenePlan plan = plan_of(scene);
    // Nothing is left out. The minimum counts surfaces by their areas, and the rest by distances.
    EXPECT_GT(plan.min_bytes, 0.75 * plan.peak_bytes());
    EXPECT_LE(plan.min_bytes, plan.peak_bytes());
}

TEST_F(PlanTest, WhatMayLeaveLittleOrLieAslantIsNotRefusedForItsBox) {
    const char* lens = R"([{"shape": "sphere", "radius": 0.3},
                           {"shape": "sphere", "radius": 0.3, "position": [0, 0.59, 0]}])";
    const char* rod =
        R"({"shape": "cylinder", "radius": 0.004, "height": 0.7, "surface": "exact"})";
    for (const std::string& model :
         {fmt::format(R"({{"shape": "intersection", "parts": {}}})", lens),
          fmt::format(R"({{"shape": "difference", "surface": "exact", "parts": {}}})", lens),
          std::string(rod)}) {
        Scene scene = scene_of(model, 1.0 / 200);
        scene.objects[0].world_from_object *=
            glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 0.3, 0.8));
        const ScenePlan plan = plan_of(scene);
        const Device device = test_device();
        WorldReport report;
        build_world(device, scene, report);
        DeviceInfo info = device.info();
        info.memory = info.max_allocation = device.counters().peak_bytes + 100'000;
        EXPECT_NO_THROW(check_memory(scene, plan, info)) << model;
    }
}

TEST_F(PlanTest, ASolidWhosePartsLieInEachOtherIsRefusedForTheLargestAlone) {
    std::string parts;
    for (int i = 0; i < 40; ++i)
        parts += fmt::format(R"({}{{"shape": "sphere", "radius": 0.3, "position": [{}, 0, 0]}})",
                             i == 0 ? "" : ", ", 0.001 * i);
    for (const char* surface : {"smooth", "cubes", "exact"}) {
        const Scene scene = scene_of(
            fmt::format(R"({{"shape": "union", "parts": [{}], "surface": "{}"}})", parts, surface),
            1.0 / 100);
        const ScenePlan plan = plan_of(scene);
        const Device device = test_device();
        WorldReport report;
        build_world(device, scene, report);
        DeviceInfo info = device.info();
        info.memory = device.counters().peak_bytes * 3 / 2;
        EXPECT_GT(plan.peak_bytes(), 0.9 * double(info.memory) / 1.5) << surface;
        EXPECT_LT(plan.peak_bytes(), double(info.memory)) << surface;
        EXPECT_NO_THROW(check_memory(scene, plan, info)) << surface;
    }
}

TEST_F(PlanTest, AMeshThatHoldsEveryTriangleTwiceIsRefusedForOneAlone) {
    write_obj(folder / "ring.obj", doubled(wavy_ring(60, 40), true));
    for (const char* surface : {"smooth", "cubes", "exact"}) {
        const Scene scene =
            scene_of(fmt::format(R"({{"mesh": "ring.obj", "surface": "{}"}})", surface), 1.0 / 200);
        const ScenePlan plan = plan_of(scene);
        const Device device = test_device();
        WorldReport report;
        build_world(device, scene, report);
        DeviceInfo info = device.info();
        info.memory = device.counters().peak_bytes * 11 / 10;
        EXPECT_GT(plan.peak_bytes(), double(info.memory)) << surface;
        EXPECT_NO_THROW(check_memory(scene, plan, info)) << surface;
    }
}

TEST_F(PlanTest, NormalsTakeTwelveBytesATriangle) {
    const Mesh mesh = wavy_ring(60, 40);
    write_obj(folder / "ring.obj", mesh);
    const auto plan = [&](const char* shading) {
        return plan_of(scene_of(
            fmt::format(R"({{"mesh": "ring.obj", "surface": "exact", "shading": "{}"}})", shading),
            1.0 / 200));
    };
    const ScenePlan flat = plan("flat"), smooth = plan("smooth");
    const double bytes = 12.0 * double(mesh.triangles.size());
    EXPECT_EQ(plan("auto").index_bytes, flat.index_bytes);
    EXPECT_EQ(smooth.world_bytes - flat.world_bytes, bytes);
    EXPECT_EQ(smooth.grids.at(0).kept_bytes - flat.grids.at(0).kept_bytes, bytes);
    EXPECT_GT(smooth.image_bytes, flat.image_bytes + bytes) << "six floats more a ray";
}

TEST_F(PlanTest, TheImagesBytesAreThoseOfItsChannelsRaysAndDilatedOccupancy) {
    for (const double voxel : {1.0 / 120, 1.0 / 400}) {
        Scene scene =
            scene_of(R"({"shape": "sphere", "radius": 0.35, "surface": "smooth"})", voxel);
        scene.render.size = {320, 240};  // enough rays for beams
        scene.render.channels = {true, true, false, true, false};
        const ScenePlan plan = plan_of(scene);
        const Device device = test_device();
        RenderReport report;
        render(device, scene, report);
        const auto& bytes = device.counters().allocated_bytes;
        const auto dilated_occupancy =
            double(bytes.at("dilated sectors") + bytes.at("dilated bricks"));
        EXPECT_GT(plan.dilated_occupancy_bytes, dilated_occupancy / 1.5) << voxel;
        EXPECT_LT(plan.dilated_occupancy_bytes, dilated_occupancy * 1.5) << voxel;
        EXPECT_EQ(bytes.at("image"), 8u * 320 * 240 * 4);
        EXPECT_FALSE(bytes.contains("object numbers"));
    }
}

}  // namespace voxelume
