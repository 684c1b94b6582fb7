// SPDX-License-Identifier: Apache-2.0
// Meshes in memory: which are retained until their model returns, and which are read again.
#include "runtime/assets/asset_store.hpp"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include "tests/support/file_fixture.hpp"
#include "tests/support/writers/gltf_writer.hpp"

namespace voxelume {
namespace {

class AssetStoreTest : public FileTest {
  protected:
    /// A model whose mesh is one triangle: 3 * 12 + 12 bytes.
    Model triangle(const char* name) {
        put_bytes(folder / name, "v 0 0 0\nv 1 0 0\nv 0 0.7 0\nf 1 2 3\n");
        Model model;
        model.name = name;
        model.mesh = folder / name;
        return model;
    }
    static constexpr uint64_t kBytes = 48;
};

TEST_F(AssetStoreTest, MeshesWaitWhereThereIsRoomAndSummariesAlways) {
    const Model a = triangle("a.obj"), b = triangle("b.obj"), c = triangle("c.obj");
    AssetStore store;
    for (const Model& model : {a, b, c}) store.summary_of(model);
    EXPECT_EQ(store.meshes_read(), 3u);
    store.forget_unused();
    store.mesh_of(c);
    uint64_t room = kBytes + 1;
    for (const Model& model : {a, b, c}) store.retain(model, room);
    EXPECT_EQ(room, 1u) << "c was asked for";
    store.forget_unused();
    for (const Model& model : {a, b, c}) store.summary_of(model);
    EXPECT_EQ(store.meshes_read(), 3u);
    store.mesh_of(a);
    store.mesh_of(c);
    EXPECT_EQ(store.meshes_read(), 3u);
    store.mesh_of(b);
    EXPECT_EQ(store.meshes_read(), 4u);
}

TEST_F(AssetStoreTest, AGlbIsAnotherOneWithAnotherFileThatItNames) {
    GltfWriter writer = triangle_gltf();
    std::string numbers = writer.bytes;
    put_bytes(folder / "numbers.bin", numbers);
    writer.json["buffers"] = {{{"byteLength", writer.bytes.size()}, {"uri", "numbers.bin"}}};
    writer.bytes.clear();
    put_bytes(folder / "a.glb", writer.glb());
    Model model;
    model.mesh = folder / "a.glb";
    const ModelCache cache(folder / "cache", 1 << 20);
    const std::string before = AssetStore(cache).source_of(model);
    EXPECT_EQ(AssetStore(cache).source_of(model), before);
    model.part = 1;
    EXPECT_NE(AssetStore(cache).source_of(model), before);
    model.part = 0;
    numbers[0] = char(numbers[0] + 1);
    put_bytes(folder / "numbers.bin", numbers);
    EXPECT_NE(AssetStore(cache).source_of(model), before);
}

/// Writes a file with two grids: a ball as a level set, and a fog.
void write_ball_and_fog(const std::filesystem::path& path) {
    openvdb::initialize();
    const auto ball = openvdb::FloatGrid::create(3.0f), fog = openvdb::FloatGrid::create(0.0f);
    ball->setGridClass(openvdb::GRID_LEVEL_SET);
    for (int x = -5; x <= 5; ++x)
        for (int y = -5; y <= 5; ++y)
            for (int z = -5; z <= 5; ++z) {
                ball->tree().setValue({x, y, z}, std::sqrt(float(x * x + y * y + z * z)) - 3.0f);
                if (x < 0) fog->tree().setValue({x, y, z}, 1.0f);
            }
    openvdb::io::File(path.string()).write({ball, fog});
}

TEST_F(AssetStoreTest, AFileOfTwoSurfacesIsReadOnceForEach) {
    write_ball_and_fog(folder / "both.vdb");
    Model ball, fog;
    ball.voxels = fog.voxels = folder / "both.vdb";
    ball.surface = Surface::smooth;
    fog.surface = Surface::cubes;
    AssetStore store;
    const VoxelModel& first = store.voxels(ball);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(&store.voxels(ball), &first);
        EXPECT_EQ(store.voxels(fog).voxels(), size_t{5 * 11 * 11});
        store.forget_unused();
    }
    EXPECT_EQ(first.surface, Surface::smooth);
    EXPECT_EQ(store.meshes_read(), 2u);
    uint64_t room = 0;
    store.forget_unused();
    store.retain(ball, room);
    store.voxels(fog);
    EXPECT_EQ(store.meshes_read(), 3u) << "without room both go";
}

TEST_F(AssetStoreTest, AMeshOnItsWayIsMadeAgainForItsOwnFramesOnly) {
    Model model = triangle("a.obj");
    model.morph = Morph{.mesh = {}, .center = glm::dvec3(0), .radius = 1, .amount = 0.5};
    AssetStore store;
    const glm::vec3 moved = store.mesh_of(model)->positions[1];
    store.forget_unused();
    store.forget_unused();
    EXPECT_EQ(store.mesh_of(model)->positions[1], moved);
    EXPECT_EQ(store.meshes_read(), 2u);
}

}  // namespace
}  // namespace voxelume
