// Estimates against surfaces whose extent is known, and plans against devices that are too small.
#include "runtime/plan.hpp"

#include <gmock/gmock.h>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "runtime/frame_plans.hpp"
#include "runtime/renderer.hpp"
#include "runtime/scene_animation.hpp"
#include "runtime/surface_extent.hpp"
#include "tests/file_fixture.hpp"
#include "tests/test_device.hpp"
#include "tests/test_meshes.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

GridFrame frame_of(const glm::dvec3& edge, const glm::ivec3& size) {
    return {glm::dvec3(0), edge, size};
}

/// A rectangle of 3 x 2 m in the plane z = 0.
Mesh rectangle() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

TEST(SurfaceExtent, AFlatPatchTakesItsShadowsVoxels) {
    const SurfaceArea area = mesh_area(rectangle());
    EXPECT_EQ(area.total, 6);
    EXPECT_EQ(area.shadows, glm::dvec3(0, 0, 6));
    const GridFrame frame = frame_of({0.01, 0.02, 0.05}, {300, 100, 40});
    const SurfaceExtent flat = surface_extent(area, glm::dmat4(1), frame, 0);
    EXPECT_NEAR(flat.voxels, 300 * 100, 1e-6);
    EXPECT_NEAR(flat.bricks, 300 * 100 / 256.0 + 8, 1e-6);
    // Stood up by swapping y and z: 3 m / 0.01 times 2 m / 0.05.
    const glm::dmat4 upright(glm::dmat3({1, 0, 0}, {0, 0, 1}, {0, 1, 0}));
    EXPECT_NEAR(surface_extent(area, upright, frame, 0).voxels, 300 * 40, 1e-6);
}

TEST(SurfaceExtent, ATurnedPatchCrossesMoreVoxels) {
    const SurfaceArea area = mesh_area(rectangle());
    const glm::dmat4 turn =
        glm::rotate(glm::dmat4(1), glm::quarter_pi<double>(), glm::dvec3(1, 0, 0));
    const GridFrame frame = frame_of(glm::dvec3(0.01), {300, 200, 200});
    const double voxels = surface_extent(area, turn, frame, 0).voxels;
    EXPECT_NEAR(voxels, std::sqrt(2.0) * 300 * 200, 1e-6);
}

TEST(SurfaceExtent, OnlyThePartInsideTheWorldCounts) {
    const SolidBounds box = {glm::dvec3(-1, 0.5, -1), glm::dvec3(9, 1, 1)};
    EXPECT_NEAR(part_inside(rectangle(), glm::dmat4(1), box), 0.25, 1e-12);
    const SolidBounds below = {glm::dvec3(-1, -1, -2), glm::dvec3(9, 9, -1)};
    EXPECT_EQ(part_inside(rectangle(), glm::dmat4(1), below), 0);
}

TEST(SurfaceExtent, FacesThatTheWorldCutsAreNoSurface) {
    Solid slab;
    slab.kind = SolidKind::slab;
    slab.thickness = 0.5;
    const SolidBounds world = {glm::dvec3(-2, -1, -3), glm::dvec3(2, 1, 3)};
    const SurfaceArea area = solid_area(slab, glm::dmat4(1), world);
    EXPECT_EQ(area.shadows, glm::dvec3(0, 2 * 4 * 6, 0));
}

/// The mesh with every triangle once more: by corners of its own, or turned over by the same ones.
Mesh doubled(Mesh mesh, bool has_own_corners) {
    const auto positions = mesh.positions;
    const auto triangles = mesh.triangles;
    const auto first = uint32_t(has_own_corners ? positions.size() : 0);
    if (has_own_corners)
        mesh.positions.insert(mesh.positions.end(), positions.begin(), positions.end());
    for (const glm::uvec3& t : triangles)
        mesh.triangles.emplace_back(t.y + first, t.x + first, t.z + first);
    return mesh;
}

TEST(SurfaceExtent, TrianglesThatLieOnOneAnotherCountOnceAtLeast) {
    const Mesh ring = wavy_ring(300, 200);
    const double once = mesh_area(ring).total;
    EXPECT_LE(least_mesh_area(ring).total, once);
    EXPECT_GT(least_mesh_area(ring).total, 0.95 * once);
    for (const bool has_own_corners : {false, true}) {
        const Mesh twice = doubled(ring, has_own_corners);
        EXPECT_NEAR(mesh_area(twice).total, 2 * once, 1e-9);
        EXPECT_LE(least_mesh_area(twice).total, once);
        EXPECT_GT(least_mesh_area(twice).total, 0.95 * once);
    }
    EXPECT_EQ(least_mesh_area(rectangle()).total, 6);
    EXPECT_EQ(least_mesh_area(doubled(rectangle(), true)).total, 6);
}

}  // namespace

class PlanTest : public FileTest {
  protected:
    Scene scene_of(const std::string& model, double voxel, const char* animation = "") {
        const std::string text = fmt::format(R"({{
            "voxelume": 1, {}
            "world": {{"voxel_size": {}, "bounds": {{"min": [0,0,0], "max": [1,0.9,0.8]}}}},
            "models": {{"thing": {}}},
            "objects": [{{"name": "thing", "model": "thing", "position": [0.5011,0.4007,0.4013]}}],
            "observer": {{"position": [0.5,0.4,3], "look_at": [0.5,0.4,0.4],
                "display": {{"shape": "pyramid", "angles": [40,30], "near": 0.1, "far": 8,
                            "voxels": [8,6,4]}}}},
            "render": {{"size": [8, 6]}}}})",
                                             animation, voxel, model);
        return parse_scene(text, folder / "scene.json", {});
    }
    ScenePlan plan_of(const Scene& scene) {
        MeshStore meshes;
        return plan_scene(scene, meshes);
    }
};

TEST_F(PlanTest, EstimatesAreWithinAHalfOfWhatFormingTheWorldTakes) {
    for (const char* model :
         {R"({"shape": "sphere", "radius": 0.35})",
          R"({"shape": "box", "size": [0.803,0.302,0.507], "surface": "cubes"})",
          R"({"shape": "torus", "radius": 0.3, "tube": 0.09})",
          R"({"shape": "ellipsoid", "radii": [0.3, 0.2, 0.25], "surface": "exact"})"}) {
        const Scene scene = scene_of(model, 1.0 / 200);
        const ScenePlan plan = plan_of(scene);
        const Device device = test_device();
        WorldReport report;
        const Pyramid world = form_world(device, scene, report);
        const double voxels = world.voxel_count;
        EXPECT_GT(plan.voxels, voxels / 1.5) << model;
        EXPECT_LT(plan.voxels, voxels * 1.5) << model;
        const double formed = std::max({plan.voxelize_bytes, plan.place_bytes, plan.index_bytes});
        const auto peak = double(device.counters().peak_bytes);
        EXPECT_GT(formed, peak / 1.5) << model;
        EXPECT_LT(formed, peak * 1.5) << model;
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
        form_world(device, scene, report);
        uint64_t largest = 0;
        for (const auto& [name, bytes] : device.counters().allocated_bytes)
            if (name.starts_with("world")) largest = std::max(largest, bytes);
        EXPECT_GT(plan.largest.bytes, 0) << surface;
        EXPECT_LE(plan.largest.bytes, double(largest)) << surface << ": " << plan.largest.name;
        EXPECT_LT(plan.least_bytes, plan.peak_bytes() / 2) << surface;
        DeviceInfo info = device.info();
        info.max_allocation = largest;
        info.memory = device.counters().peak_bytes * 3 / 2;
        EXPECT_NO_THROW(check_memory(scene, plan, info)) << surface;
    }
}

TEST_F(PlanTest, ObjectsApartAreAllRefusedWithTheirMemory) {
    Scene scene = scene_of(R"({"shape": "box", "size": [0.1, 0.1, 0.1]})", 1.0 / 200);
    const Object ball = scene.objects[0];
    for (const glm::dvec3 step : {glm::dvec3(0.25, 0, 0), glm::dvec3(-0.25, 0, 0),
                                  glm::dvec3(0, 0.25, 0), glm::dvec3(0, 0, -0.25)}) {
        scene.objects.push_back(ball);
        scene.objects.back().world_from_object =
            glm::translate(glm::dmat4(1), step) * ball.world_from_object;
    }
    const ScenePlan plan = plan_of(scene);
    EXPECT_DOUBLE_EQ(plan.least_bytes, plan.peak_bytes());
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
        form_world(device, scene, report);
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
        form_world(device, scene, report);
        DeviceInfo info = device.info();
        info.memory = device.counters().peak_bytes * 3 / 2;
        EXPECT_GT(plan.peak_bytes(), double(info.memory)) << surface;
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
        form_world(device, scene, report);
        DeviceInfo info = device.info();
        info.memory = device.counters().peak_bytes * 11 / 10;
        EXPECT_GT(plan.peak_bytes(), double(info.memory)) << surface;
        EXPECT_NO_THROW(check_memory(scene, plan, info)) << surface;
    }
}

TEST_F(PlanTest, TheImagesBytesAreThoseOfItsChannelsRaysAndHalo) {
    for (const double voxel : {1.0 / 120, 1.0 / 400}) {
        Scene scene = scene_of(R"({"shape": "sphere", "radius": 0.35})", voxel);
        scene.render.size = {320, 240};  // enough rays for beams
        scene.render.channels = {true, false, true, false};
        const ScenePlan plan = plan_of(scene);
        const Device device = test_device();
        RenderReport report;
        render(device, scene, report);
        const auto& bytes = device.counters().allocated_bytes;
        const auto halo = double(bytes.at("halo sectors") + bytes.at("halo bricks"));
        EXPECT_GT(plan.halo_bytes, halo / 1.5) << voxel;
        EXPECT_LT(plan.halo_bytes, halo * 1.5) << voxel;
        EXPECT_EQ(bytes.at("image"), 8u * 320 * 240 * 4);
        EXPECT_FALSE(bytes.contains("object numbers"));
    }
}

TEST_F(PlanTest, APlanBeyondADevicesMemoryNamesBothAndTheWayOut) {
    DeviceInfo device;
    device.name = "Small One";
    device.memory = device.max_allocation = 20'000'000;
    const Scene scene = scene_of(R"({"shape": "sphere", "radius": 0.35})", 1.0 / 400);
    const Error error = error_of([&] { check_memory(scene, plan_of(scene), device); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_THAT(error.what(), HasSubstr("on \"Small One\", which has 20.0 MB: use voxels larger"));
    device.memory = device.max_allocation = 8'000'000'000;
    EXPECT_NO_THROW(check_memory(scene, plan_of(scene), device));
}

TEST_F(PlanTest, ABufferBeyondOnePieceIsNamedWithItsOwnerAndTheWayOut) {
    DeviceInfo device;
    device.name = "Small One";
    device.memory = 8'000'000'000;
    const auto refusal = [&](const std::string& model, double most) {
        const Scene scene = scene_of(model, 1.0 / 400);
        const ScenePlan plan = plan_of(scene);
        device.max_allocation = uint64_t(most * 1e6);
        const Error error = error_of([&] { check_memory(scene, plan, device); });
        EXPECT_EQ(error.kind(), ErrorKind::limit);
        return std::string(error.what());
    };
    const std::string ball = R"({"shape": "sphere", "radius": 0.35, "surface": ")";
    // 369,000 voxels in three pairs of disks 280 wide, 2.8 about them: 1,780 bricks of 8,192 bytes
    EXPECT_THAT(refusal(ball + "smooth\"}", 12),
                HasSubstr(": models.thing: a model of 288x288x288 voxels needs a buffer of "
                          "14.6 MB for its distances, and \"Small One\" allows 12.0 MB in "
                          "one piece: use voxels larger than 0.0029 m"));
    EXPECT_THAT(refusal(ball + "smooth\", \"voxel_size\": 0.02}", 9),
                HasSubstr(": world: a world of 400x360x320 voxels needs a buffer of 14.6 MB for "
                          "its distances"));
    EXPECT_THAT(refusal(ball + "cubes\", \"voxel_size\": 0.02}", 1),
                HasSubstr(": world: a world of 400x360x320 voxels needs a buffer of 1.1 MB for "
                          "its voxels"));
    EXPECT_THAT(refusal(ball + "exact\"}", 12),
                HasSubstr("an object in a world of 400x360x320 voxels needs a buffer of"));
}

TEST_F(PlanTest, ABufferOfTrianglesAsksForFewerOfThem) {
    write_obj(folder / "ring.obj", wavy_ring(300, 200));
    DeviceInfo device;
    device.name = "Small One";
    device.memory = 8'000'000'000;
    device.max_allocation = 2'400'000;
    const Scene scene = scene_of(R"({"mesh": "ring.obj", "voxel_size": 0.2})", 0.05);
    const Error error = error_of([&] { check_memory(scene, plan_of(scene), device); });
    // 120,000 triangles of 80 bytes
    EXPECT_THAT(error.what(), HasSubstr("needs a buffer of 9.6 MB for its triangles"));
    EXPECT_THAT(error.what(), testing::EndsWith("use meshes with 0.24 of the triangles"));
}

TEST_F(PlanTest, AnImageBeyondOneBufferIsToBeSmaller) {
    DeviceInfo device;
    device.name = "Small One";
    device.memory = 8'000'000'000;
    device.max_allocation = 40'000'000;
    Scene scene = scene_of(R"({"shape": "sphere", "radius": 0.35})", 1.0 / 50);
    scene.render.size = {1000, 900};
    EXPECT_NO_THROW(check_memory(scene, plan_of(scene), device));
    scene.render.size = {1000, 1000};
    const Error error = error_of([&] { check_memory(scene, plan_of(scene), device); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_THAT(error.what(), HasSubstr("a buffer of 44.0 MB, and \"Small One\" allows 40.0 MB"));
}

TEST_F(PlanTest, TablesAreCheckedBeforeAnyMeshIsRead) {
    DeviceInfo device;
    device.name = "Small One";
    device.memory = device.max_allocation = 1'000'000;
    const Scene scene = scene_of(R"({"shape": "sphere", "radius": 0.35})", 1.0 / 2000);
    const Error error = error_of([&] { check_tables(scene, device); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    // 126 x 113 x 101 bricks of 4 bytes
    EXPECT_THAT(error.what(), HasSubstr("a table of 5.8 MB, and \"Small One\" allows 1.0 MB"));
    device.memory = device.max_allocation = uint64_t{1} << 60;
    const Scene largest = scene_of(R"({"shape": "sphere", "radius": 0.35})", 1.0 / 65536);
    EXPECT_THAT(error_of([&] { check_tables(largest, device); }).what(), HasSubstr("2^31 bricks"));
}

TEST_F(PlanTest, AnExactMeshInAWorldBeyondItsLatticeIsToBeAnInstance) {
    write_obj(folder / "ring.obj", wavy_ring(30, 20));
    const std::string model = R"({"mesh": "ring.obj", "surface": "exact"})";
    EXPECT_NO_THROW(plan_of(scene_of(model, 1.0 / 1024)));
    const Scene larger = scene_of(model, 1.0 / 16385);
    EXPECT_THAT(
        error_of([&] { plan_of(larger); }).what(),
        testing::AllOf(HasSubstr("objects[0]: an exact mesh in a world of 16385 x 14747 x "),
                       HasSubstr("\"placement\": \"instance\"")));
}

/// A ball whose radius grows from frame 1 to 3 and is small again in frame 5.
constexpr const char* kGrowth = R"("animation": {"frames": 5, "tracks": [
    {"target": "models.thing.radius", "keys": [{"frame": 1, "value": 0.1}, {"frame": 3, "value": 0.35},
                                               {"frame": 5, "value": 0.1}]}]},)";

TEST_F(PlanTest, OfFramesTheLargestCountsAndTheFirstThatDoesNotFitIsNamed) {
    const Scene scene = scene_of(R"({"shape": "sphere", "radius": 0.1})", 1.0 / 200, kGrowth);
    DeviceInfo device;
    device.name = "Small One";
    device.memory = device.max_allocation = 8'000'000'000;
    const std::vector<int> frames = {1, 2, 3, 4, 5};
    MeshStore meshes;
    const FramePlan most = plan_frames(scene, frames, meshes, device);
    EXPECT_EQ(most.frame, 3);
    EXPECT_EQ(most.plan.peak_bytes(), plan_of(scene_at(scene, 3)).peak_bytes());
    EXPECT_NO_THROW(check_frames(scene, frames, meshes, device));
    // The first takes 0.9 MB, the second 4.0, the third 9.4.
    device.memory = 3'000'000;
    EXPECT_EQ(plan_frames(scene, frames, meshes, device).frame, 2);
    const Error error = error_of([&] { check_frames(scene, frames, meshes, device); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_THAT(error.what(), testing::EndsWith("(at frame 2)"));
    EXPECT_NO_THROW(check_frames(scene, std::vector<int>{1, 5}, meshes, device));
}

TEST_F(PlanTest, AGroupThatAMeshDoesNotHaveIsNamedBeforeAnyFrameIsRendered) {
    put_bytes(folder / "plate.obj",
              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nusemtl near\nf 1 2 3\nusemtl far\nf 2 4 3\n");
    constexpr const char* kText = R"({{"voxelume": 1,
        "world": {{"voxel_size": 0.1, "bounds": {{"min": [0,0,0], "max": [1,0.9,0.8]}}}},
        "materials": {{"red": {{}}}}, "models": {{"plate": {{"mesh": "plate.obj"}}}},
        "objects": [{{"name": "plate", "model": "plate", "placement": "{}",
                     "materials": {{"{}": "red"}}}}],
        "observer": {{"position": [0.5,0.4,3], "look_at": [0.5,0.4,0.4],
                     "display": {{"shape": "pyramid", "angle": 40}}}},
        "animation": {{"frames": 4, "tracks": [{{"target": "objects.plate.visible",
            "keys": [{{"frame": 1, "value": false}}, {{"frame": 3, "value": true}}]}}]}}}})";
    DeviceInfo device;
    device.memory = device.max_allocation = 8'000'000'000;
    const std::vector<int> frames = {1, 2, 3, 4};
    for (const char* placement : {"world", "instance"}) {
        const auto scene = [&](const char* group) {
            return parse_scene(fmt::format(kText, placement, group), folder / "scene.json", {});
        };
        MeshStore meshes;
        EXPECT_NO_THROW(check_frames(scene("far"), frames, meshes, device));
        const Scene wrong = scene("fare");
        for (const Error& error : {error_of([&] { check_frames(wrong, frames, meshes, device); }),
                                   error_of([&] { plan_frames(wrong, frames, meshes, device); })}) {
            EXPECT_EQ(error.kind(), ErrorKind::scene);
            EXPECT_THAT(error.what(), HasSubstr("the mesh has no group of faces named \"fare\"; "
                                                "did you mean \"far\"? (at frame 3)"));
        }
    }
}

TEST(BytesText, HasAboutThreeDigits) {
    EXPECT_EQ(bytes_text(1234), "1.2 kB");
    EXPECT_EQ(bytes_text(31.25e6), "31.2 MB");
    EXPECT_EQ(bytes_text(275e9), "275 GB");
}

}  // namespace voxelume
