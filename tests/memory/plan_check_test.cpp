// SPDX-License-Identifier: Apache-2.0
// Plans against devices that are too small.
#include <gmock/gmock.h>

#include "tests/memory/plan_fixture.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {

using testing::HasSubstr;

using PlanCheck = PlanTest;

TEST_F(PlanCheck, APlanBeyondADevicesMemoryNamesBothAndTheWayOut) {
    DeviceInfo device;
    device.name = "Small One";
    device.memory = device.max_allocation = 20'000'000;
    const Scene scene =
        scene_of(R"({"shape": "sphere", "radius": 0.35, "surface": "smooth"})", 1.0 / 400);
    const Error error = error_of([&] { check_memory(scene, plan_of(scene), device); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_THAT(error.what(), HasSubstr("on \"Small One\", which has 20.0 MB: use voxels larger"));
    device.memory = device.max_allocation = 8'000'000'000;
    EXPECT_NO_THROW(check_memory(scene, plan_of(scene), device));
}

TEST_F(PlanCheck, ABufferBeyondOnePieceIsNamedWithItsOwnerAndTheWayOut) {
    DeviceInfo device;
    device.name = "Small One";
    device.memory = 8'000'000'000;
    const auto refusal = [&](const std::string& model, double maximum,
                             Placement placement = Placement::automatic) {
        Scene scene = scene_of(model, 1.0 / 400);
        scene.objects[0].placement = placement;
        const ScenePlan plan = plan_of(scene);
        device.max_allocation = uint64_t(maximum * 1e6);
        const Error error = error_of([&] { check_memory(scene, plan, device); });
        EXPECT_EQ(error.kind(), ErrorKind::limit);
        return std::string(error.what());
    };
    const std::string ball = R"({"shape": "sphere", "radius": 0.35, "surface": ")";
    // The surface has 369,000 voxels, in three pairs of disks 280 wide and 2.8 around them: 1,780
    // bricks of 8,192 bytes.
    EXPECT_THAT(refusal(ball + "smooth\"}", 12),
                HasSubstr(": objects[0]: an object's part of the world of 304x320x320 voxels needs "
                          "a buffer of 14.6 MB for its distances, and \"Small One\" allows 12.0 MB "
                          "in one piece: use voxels larger than 0.0029 m"));
    // An instance has its own lattice.
    EXPECT_THAT(refusal(ball + "smooth\"}", 12, Placement::instance),
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

TEST_F(PlanCheck, ABufferOfTrianglesAsksForFewerOfThem) {
    write_obj(folder / "ring.obj", wavy_ring(300, 200));
    DeviceInfo device;
    device.name = "Small One";
    device.memory = 8'000'000'000;
    device.max_allocation = 2'400'000;
    const Scene scene =
        scene_of(R"({"mesh": "ring.obj", "voxel_size": 0.2, "surface": "smooth"})", 0.05);
    const Error error = error_of([&] { check_memory(scene, plan_of(scene), device); });
    // 120,000 triangles take 80 bytes each.
    EXPECT_THAT(error.what(), HasSubstr("needs a buffer of 9.6 MB for its triangles"));
    EXPECT_THAT(error.what(), testing::EndsWith("use meshes with 0.24 of the triangles"));
}

TEST_F(PlanCheck, AnImageBeyondOneBufferIsToBeSmaller) {
    DeviceInfo device;
    device.name = "Small One";
    device.memory = 8'000'000'000;
    device.max_allocation = 40'000'000;
    Scene scene = scene_of(R"({"shape": "sphere", "radius": 0.35, "surface": "smooth"})", 1.0 / 50);
    scene.render.size = {1000, 900};
    EXPECT_NO_THROW(check_memory(scene, plan_of(scene), device));
    scene.render.size = {1000, 1000};
    const Error error = error_of([&] { check_memory(scene, plan_of(scene), device); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_THAT(error.what(), HasSubstr("a buffer of 44.0 MB, and \"Small One\" allows 40.0 MB"));
}

TEST_F(PlanCheck, TablesAreCheckedBeforeAnyMeshIsRead) {
    DeviceInfo device;
    device.name = "Small One";
    device.memory = device.max_allocation = 1'000'000;
    const Scene scene =
        scene_of(R"({"shape": "sphere", "radius": 0.35, "surface": "smooth"})", 1.0 / 2000);
    const Error error = error_of([&] { check_tables(scene, device); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    // The table has 126 x 113 x 101 bricks of 4 bytes.
    EXPECT_THAT(error.what(), HasSubstr("a table of 5.8 MB, and \"Small One\" allows 1.0 MB"));
    device.memory = device.max_allocation = uint64_t{1} << 60;
    const Scene largest =
        scene_of(R"({"shape": "sphere", "radius": 0.35, "surface": "smooth"})", 1.0 / 65536);
    EXPECT_THAT(error_of([&] { check_tables(largest, device); }).what(), HasSubstr("2^31 bricks"));
}

TEST_F(PlanCheck, AnExactMeshInAWorldBeyondItsLatticeIsToBeAnInstance) {
    write_obj(folder / "ring.obj", wavy_ring(30, 20));
    const std::string model = R"({"mesh": "ring.obj", "surface": "exact"})";
    EXPECT_NO_THROW(plan_of(scene_of(model, 1.0 / 1024)));
    const Scene larger = scene_of(model, 1.0 / 16385);
    EXPECT_THAT(
        error_of([&] { plan_of(larger); }).what(),
        testing::AllOf(HasSubstr("objects[0]: an exact mesh in a world of 16385 x 14747 x "),
                       HasSubstr("\"placement\": \"instance\"")));
}

TEST_F(PlanCheck, AMeshThatReachesTooFarIsRefused) {
    write_obj(folder / "ring.obj", wavy_ring(30, 20));
    const auto times = [&](double scale) {
        Scene scene = scene_of(R"({"mesh": "ring.obj", "surface": "exact"})", 0.05);
        scene.objects[0].world_from_object *= glm::dmat4(glm::dmat3(scale));
        return scene;
    };
    EXPECT_NO_THROW(plan_of(times(500)));
    EXPECT_THAT(error_of([&] { plan_of(times(5000)); }).what(),
                testing::AllOf(HasSubstr("objects[0]: the mesh reaches"), HasSubstr("unit")));
}

TEST(BytesText, HasAboutThreeDigits) {
    EXPECT_EQ(bytes_text(1234), "1.2 kB");
    EXPECT_EQ(bytes_text(31.25e6), "31.2 MB");
    EXPECT_EQ(bytes_text(275e9), "275 GB");
}

}  // namespace voxelume
