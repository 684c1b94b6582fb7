// SPDX-License-Identifier: Apache-2.0
// Files of models are measured and mapped as they are read, once.
#include "runtime/geometry/file_map.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "runtime/assets/asset_store.hpp"
#include "runtime/base/error.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

class FileMaps : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        // The last vertex is in no triangle, so it doesn't belong to the surface.
        put_bytes(folder / "m.obj",
                  "v 1 0 0\nv 3 0 0.1\nv 1 0.7 0\nv 1 0 -0.5\nv 9 9 9\n"
                  "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
        model.name = "m";
        model.mesh = folder / "m.obj";
    }

    Model mapped_model(double scale, glm::dvec3 shift) const {
        Model result = model;
        result.object_from_file = {scale, shift};
        return result;
    }

    ModelCache cache() const { return ModelCache(folder / "models", 64 << 20, 0); }

    Model model;
};

const FileMap kMap{0.3, {-0.6, 0.1, 7}};

}  // namespace

TEST_F(FileMaps, MoveEveryPositionToTheNearestFloat) {
    AssetStore store;
    const Mesh plain = *store.mesh_of(model);
    const Mesh& moved = *store.mesh_of(mapped_model(kMap.scale, kMap.shift));
    ASSERT_EQ(moved.positions.size(), plain.positions.size());
    EXPECT_EQ(moved.triangles, plain.triangles);
    for (size_t i = 0; i < plain.positions.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_EQ(moved.positions[i][axis],
                      float(0.3 * double(plain.positions[i][axis]) + kMap.shift[axis]));
}

TEST_F(FileMaps, GiveTheSummaryOfTheMovedMesh) {
    AssetStore store;
    const Model moved = mapped_model(kMap.scale, kMap.shift);
    const MeshSummary given = *store.summary_of(moved);
    const MeshSummary computed = summary_of(*store.mesh_of(moved));
    EXPECT_EQ(given.surface, computed.surface);
    EXPECT_EQ(given.vertices, computed.vertices);
    EXPECT_EQ(given.triangles, computed.triangles);
    EXPECT_NEAR(given.area.total, computed.area.total, 1e-6 * computed.area.total);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(given.min_area.shadows[axis], computed.min_area.shadows[axis], 1e-6);
}

TEST_F(FileMaps, ScaleHolesAndVolumesWithTheMesh) {
    put_bytes(folder / "m.obj",
              "v 1 0 0\nv 3 0 0.1\nv 1 0.7 0\nv 1 0 -0.5\n"
              "f 1 3 2\nf 1 2 4\nf 2 3 4\n");
    AssetStore store;
    const Model moved = mapped_model(kMap.scale, kMap.shift);
    const MeshTopology given = store.summary_of(moved)->topology;
    const MeshTopology computed = mesh_topology(*store.mesh_of(moved));
    EXPECT_EQ(given.open_edges, 3u);
    EXPECT_NEAR(given.hole_area, 0.09 * 0.5 * 0.7 * 0.5, 1e-7);
    EXPECT_NEAR(given.hole_area, computed.hole_area, 1e-7);
    EXPECT_NEAR(given.volume, computed.volume, 1e-7);
}

TEST_F(FileMaps, AFileIsReadOnceForItsBoxItsSummaryAndItsMesh) {
    for (const bool has_cache : {false, true}) {
        AssetStore store(has_cache ? cache() : ModelCache());
        const Bounds box = store.box_of_file(model, true);
        EXPECT_EQ(box.min, glm::dvec3(1, 0, -0.5));
        EXPECT_EQ(box.max, glm::dvec3(3, double(0.7f), double(0.1f)));
        const Model fitted = mapped_model(0.5, {-1, 0, 0});
        store.summary_of(fitted);
        store.mesh_of(fitted);
        Model twin = fitted;
        twin.name = "twin";
        twin.surface = Surface::exact;
        store.mesh_of(twin);
        EXPECT_EQ(store.meshes_read(), 1u) << has_cache;
        EXPECT_EQ(store.triangles(), 4u);
    }
}

TEST_F(FileMaps, AKnownFileIsMeasuredWithoutReadingItsMesh) {
    AssetStore first(cache()), second(cache());
    const Bounds box = first.box_of_file(model, true);
    EXPECT_EQ(second.box_of_file(model, true), box);
    EXPECT_EQ(second.meshes_read(), 0u);
}

TEST_F(FileMaps, ContentsThatLaterFramesShowAreNotKept) {
    AssetStore store;
    const Bounds box = store.box_of_file(model, false);
    EXPECT_EQ(store.meshes_read(), 1u);
    EXPECT_EQ(store.box_of_file(model, false), box) << "the summary is kept";
    EXPECT_EQ(store.meshes_read(), 1u);
    store.mesh_of(model);
    EXPECT_EQ(store.meshes_read(), 2u);
    store.box_of_file(model, false);
    store.mesh_of(model);
    EXPECT_EQ(store.meshes_read(), 2u) << "what was loaded before stays";
}

TEST_F(FileMaps, GiveVoxelsOnDiskAnotherSource) {
    AssetStore store(cache());
    const std::string plain = store.source_of(model);
    const std::string half = store.source_of(mapped_model(0.5, {0, 0, 0}));
    const std::string shifted = store.source_of(mapped_model(0.5, {0, 0, 1e-9}));
    EXPECT_NE(plain, half);
    EXPECT_NE(half, shifted);
    EXPECT_EQ(half, store.source_of(mapped_model(0.5, {0, 0, 0})));
    Model morphed = mapped_model(0.5, {0, 0, 0});
    morphed.morph = Morph{};
    const std::string from_half = store.source_of(morphed);
    morphed.object_from_file = {};
    EXPECT_NE(from_half, store.source_of(morphed));
}

TEST_F(FileMaps, MorphsBeginAtTheMovedMesh) {
    Model morphed = mapped_model(2, {1, 0, 0});
    morphed.morph = Morph{.mesh = {}, .center = {0, 0, 0}, .radius = 1, .amount = 0};
    AssetStore store;
    EXPECT_EQ(store.mesh_of(morphed)->positions[1], glm::vec3(7, 0, 0.2f));
}

TEST_F(FileMaps, RefuseWhatNoFloatHolds) {
    put_bytes(folder / "m.obj", "v 1e37 0 0\nv 3 0 0\nv 1 0.7 0\nf 1 3 2\n");
    AssetStore store;
    const Error error = error_of([&] { store.mesh_of(mapped_model(1e3, {0, 0, 0})); });
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_THAT(error.what(), testing::HasSubstr("m.obj: in metres a coordinate is too large"));
}

TEST(OccupiedBounds, AreThoseOfTheVoxelsAndNotOfTheirBricks) {
    VoxelModel voxels;
    voxels.frame.origin = {-1, 2, 0};
    voxels.frame.voxel_edge = {0.5, 0.25, 1};
    voxels.frame.size = {40, 20, 20};  // 3 x 2 x 2 bricks
    voxels.coordinates = {0, 2 + 3 * (1 + 2 * 1)};
    voxels.occupancy.assign(2 * kLeavesPerBrick, 0);
    const auto set = [&](size_t slot, glm::ivec3 cell) {
        const glm::ivec3 leaf = cell / 4, in = cell % 4;
        voxels.occupancy[slot * kLeavesPerBrick + size_t(leaf.x + 4 * leaf.y + 16 * leaf.z)] |=
            uint64_t{1} << (in.x + 4 * in.y + 16 * in.z);
    };
    set(0, {5, 9, 14});
    EXPECT_EQ(occupied_bounds(voxels), (Bounds{{1.5, 4.25, 14}, {2, 4.5, 15}}));
    set(1, {1, 2, 3});  // cell 33, 18, 19 of the model
    EXPECT_EQ(occupied_bounds(voxels), (Bounds{{1.5, 4.25, 14}, {16, 6.75, 20}}));
}

TEST(OccupiedBounds, AreThoseOfVoxelsNearASmoothSurface) {
    VoxelModel voxels;
    voxels.frame.voxel_edge = {1, 1, 1};
    voxels.frame.size = {10, 10, 10};
    voxels.surface = Surface::smooth;
    voxels.coordinates = {0};
    voxels.distance.assign(kVoxelsPerBrick, 32767);
    voxels.distance[3 + 16 * 4 + 256 * 5] = 8191;
    voxels.distance[6 + 16 * 4 + 256 * 2] = -8191;
    voxels.distance[9 + 16 * 9 + 256 * 9] = 8192;
    EXPECT_EQ(occupied_bounds(voxels), (Bounds{{3, 4, 2}, {7, 5, 6}}));
}

}  // namespace voxelume
