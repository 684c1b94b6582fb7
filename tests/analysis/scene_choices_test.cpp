// SPDX-License-Identifier: Apache-2.0
// The choices that scenes leave to their models' files: `"surface": "auto"`.
#include "runtime/analysis/scene_choices.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "runtime/render/renderer.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "tests/analysis/chosen_scene.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/writers/array_writer.hpp"

namespace voxelume {
namespace {

using SceneChoices = ChosenScene;

TEST_F(SceneChoices, GiveMeshesTheSurfaceThatSuitsThem) {
    EXPECT_EQ(chosen(R"("mesh": "ring.obj")").surface, Surface::smooth);
    const Model box = chosen(R"("mesh": "box.obj")");
    EXPECT_EQ(box.surface, Surface::exact);
    EXPECT_THAT(box.surface_reason, testing::HasSubstr("edges"));
}

TEST_F(SceneChoices, KeepTheNormalsOfAFile) {
    const Mesh mesh = wavy_ring(40, 20);
    std::string text;
    for (const glm::vec3& v : mesh.positions)
        text += fmt::format("v {0} {1} {2}\nvn {0} {1} {2}\n", v.x, v.y, v.z);
    for (const auto& t : mesh.triangles)
        text += fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    put_bytes(folder / "normals.obj", text);
    const Model model = chosen(R"("mesh": "normals.obj")");
    EXPECT_EQ(model.surface, Surface::exact);
    EXPECT_THAT(model.surface_reason, testing::HasSubstr("normals"));
    EXPECT_EQ(chosen(R"("mesh": "ring.obj", "shading": "smooth")").surface, Surface::exact);
}

TEST_F(SceneChoices, KeepSoftCubesCoarserThanTheWorldWhole) {
    const auto placed = [&](const char* size, const char* keys) {
        Scene scene = scene_of(fmt::format(R"("mesh": "ring.obj", "surface": "cubes",
                                               "normals": "surface", "voxel_size": {})",
                                           size),
                               keys);
        AssetStore meshes;
        make_choices(scene, meshes);
        return scene.objects[0].placement;
    };
    EXPECT_EQ(placed("0.05", ""), Placement::instance);
    EXPECT_EQ(placed("0.015", R"(, "scale": 3)"), Placement::instance);
    EXPECT_EQ(placed("0.02", ""), Placement::automatic);
    EXPECT_EQ(placed("0.05", R"(, "placement": "world")"), Placement::world);
}

TEST_F(SceneChoices, GiveSolidsTheirExactSurface) {
    const Scene scene = scene_of(R"("shape": "sphere", "radius": 0.3, "surface": "auto")");
    EXPECT_EQ(scene.models[0].surface, Surface::exact) << "without reading files";
    EXPECT_EQ(chosen(R"("shape": "sphere", "radius": 0.3)").surface, Surface::exact);
}

TEST_F(SceneChoices, LeaveWhatTheSceneSays) {
    for (const SurfaceKind& kind : kSurfaceKinds)
        for (const char* model : {R"("mesh": "box.obj")", R"("mesh": "ring.obj")",
                                  R"("shape": "sphere", "radius": 0.3)"}) {
            const Model left = chosen(fmt::format(R"({}, "surface": "{}")", model, kind.name));
            EXPECT_EQ(left.surface, kind.surface) << model;
            EXPECT_EQ(left.surface_reason, "");
        }
}

TEST_F(SceneChoices, MakeOnlyThinPartsExact) {
    const std::string blade = R"("mesh": "blade.obj", "fit": 0.8)";
    const Model model = chosen(blade);
    EXPECT_EQ(model.surface, Surface::smooth);
    EXPECT_DOUBLE_EQ(model.thin_edge, 0.02);
    EXPECT_THAT(model.surface_reason, testing::HasSubstr("and is exact"));
    ASSERT_TRUE(thin_part_of(model));
    EXPECT_EQ(thin_part_of(model)->surface, Surface::exact);
    EXPECT_FALSE(thin_part_of(*thin_part_of(model)));
    Model cubes = model;
    cubes.surface = Surface::cubes;
    EXPECT_FALSE(thin_part_of(cubes)) << "as a scene that is voxelized";
    EXPECT_EQ(chosen(R"("mesh": "ring.obj")").thin_edge, 0);
    EXPECT_EQ(chosen(blade + R"(, "surface": "smooth")").thin_edge, 0);
    const char* const kMoves =
        R"({"target": "objects[0].position", "keys": [{"frame": 1, "value": [0, 0, 0]}, {"frame": 4, "value": [0.1, 0, 0]}]})";
    EXPECT_EQ(chosen(blade, "", kMoves).thin_edge, 0);
    EXPECT_EQ(chosen(blade, R"(, "position": [0.4, 0, 0])").surface, Surface::exact) << "cut off";
    EXPECT_EQ(chosen(R"("mesh": "fin.obj", "fit": 0.8)").surface, Surface::exact) << "a large part";
}

// Where the two surfaces overlap, one would be seen behind the other.
TEST_F(SceneChoices, MakeNoPartsExactWhereSurfacesCantOverlap) {
    const std::string blade = R"("mesh": "blade.obj", "fit": 0.8)";
    Material glass, veil, emissive;
    glass.transmission = 0.9f;
    veil.opacity = 0.5f;
    emissive.emission = glm::vec3(3);
    for (const Material& material : {glass, veil, emissive}) {
        Scene scene = scene_of(blade + R"(, "surface": "auto")");
        scene.materials.push_back(material);
        scene.objects.push_back(scene.objects[0]);
        scene.objects[1].material = int(scene.materials.size()) - 1;
        AssetStore meshes;
        make_choices(scene, meshes);
        EXPECT_EQ(scene.models[0].thin_edge, 0);
    }
    std::ifstream plain(folder / "blade.obj");
    std::string colored, line;
    while (std::getline(plain, line)) colored += line + (line[0] == 'v' ? " 1 0.5 0\n" : "\n");
    put_bytes(folder / "colored.obj", colored);
    const Model in_colors = chosen(R"("mesh": "colored.obj", "fit": 0.8)");
    EXPECT_EQ(in_colors.thin_edge, 0);
    EXPECT_THAT(in_colors.surface_reason, testing::HasSubstr("voxels, and it has colours"));
    const char* const kMorph = R"(, "morph": {"center": [0, 0, 0], "radius": 0.3, "amount": 0})";
    EXPECT_EQ(chosen(blade + kMorph).thin_edge, 0);
    const char* const kHides =
        R"({"target": "objects[0].visible", "keys": [{"frame": 1, "value": true}, {"frame": 3, "value": false}]})";
    EXPECT_EQ(chosen(blade, "", kHides).thin_edge, 0);
}

TEST_F(SceneChoices, MakeACutMeshSmooth) {
    EXPECT_EQ(chosen(R"("mesh": "box.obj", "cut": [{"shape": "sphere", "radius": 0.2}])").surface,
              Surface::smooth);
}

TEST_F(SceneChoices, CountTheLargestVoxelsOfAllObjects) {
    // The ring's tube is 0.28 thick: 14 voxels, 7 at half the size, and 1.4 at a tenth.
    EXPECT_EQ(chosen(R"("mesh": "ring.obj")", R"(, "scale": 0.5)").surface, Surface::smooth);
    EXPECT_EQ(chosen(R"("mesh": "ring.obj")", R"(, "scale": 0.08)").surface, Surface::exact);
    EXPECT_EQ(chosen(R"("mesh": "ring.obj")", R"(}, {"model": "m", "scale": 0.08)").surface,
              Surface::exact);
    EXPECT_EQ(chosen(R"("mesh": "ring.obj", "voxel_size": 0.25)").surface, Surface::exact);
    EXPECT_EQ(chosen(R"("mesh": "ring.obj", "resolution": 500)").surface, Surface::smooth);
}

TEST_F(SceneChoices, CountTheSizeThatTheMeshIsGiven) {
    // The file's longest side is about 1.6.
    EXPECT_EQ(chosen(R"("mesh": "ring.obj", "unit": "dm")").surface, Surface::exact);
    EXPECT_EQ(chosen(R"("mesh": "ring.obj", "fit": 0.1)").surface, Surface::exact);
    EXPECT_EQ(chosen(R"("mesh": "ring.obj", "fit": 1)").surface, Surface::smooth);
}

TEST_F(SceneChoices, AreKnownToTheCacheWithoutTheMesh) {
    const ModelCache cache(folder / "cache", 1 << 20, 0);
    for (const bool is_known : {false, true}) {
        Scene scene = scene_of(R"("mesh": "box.obj", "surface": "auto")");
        AssetStore meshes(cache);
        make_choices(scene, meshes);
        EXPECT_EQ(scene.models[0].surface, Surface::exact);
        EXPECT_EQ(meshes.meshes_read(), is_known ? 0u : 1u);
    }
}

TEST_F(SceneChoices, GiveFilesOfVoxelsWhatTheyHold) {
    voxelize("cubes.vxm", Surface::cubes);
    voxelize("smooth.vxm", Surface::smooth);
    voxelize("exact.vxm", Surface::exact);
    EXPECT_EQ(chosen(R"("voxels": "cubes.vxm")").surface, Surface::cubes);
    EXPECT_EQ(chosen(R"("voxels": "smooth.vxm")").surface, Surface::smooth);
    EXPECT_EQ(chosen(R"("voxels": "exact.vxm")").surface, Surface::exact);
    voxelize("smooth.vdb", Surface::smooth);
    voxelize("cubes.vdb", Surface::cubes);
    EXPECT_EQ(chosen(R"("voxels": "smooth.vdb")").surface, Surface::smooth);
    EXPECT_EQ(chosen(R"("voxels": "cubes.vdb")").surface, Surface::cubes);
    for (const char* file : {"smooth.vxm", "exact.vxm", "smooth.vdb"})
        EXPECT_GT(chosen(fmt::format(R"("voxels": "{}", "fit": 0.8)", file)).object_from_file.scale,
                  0.1)
            << "is measured as what it holds";
}

// Rays go through cubes of the world only, and the file alone tells that they do.
TEST_F(SceneChoices, LeaveFilesWithClearVoxelsInTheWorld) {
    const std::string tracks =
        R"({"target": "objects[0].position", "keys": [{"frame": 1, "value": [0, 0, 0]}, {"frame": 4, "value": [0.1, 0, 0]}]})";
    for (const uint8_t opacity : {uint8_t(128), uint8_t(255)}) {
        const std::vector<uint8_t> rgba = {200, 100, 50, 255, 90, 80, 70, opacity};
        put_bytes(folder / "two.npy", npy_bytes("|u1", "2, 1, 1, 4", bytes_of_values(rgba)));
        Scene scene =
            scene_of(R"("voxels": "two.npy", "surface": "cubes")", R"(, "scale": 0.1)", tracks);
        AssetStore meshes;
        make_choices(scene, meshes);
        EXPECT_EQ(is_instanced(scene, scene.objects[0]), opacity == 255);
        RenderReport report;
        EXPECT_NO_THROW(render(shared_device(), scene, report));
    }
}

TEST_F(SceneChoices, AreTheSameInAllFrames) {
    const std::string tracks =
        R"({"target": "objects[0].scale", "keys": [{"frame": 1, "value": 1}, {"frame": 4, "value": 0.02}]})";
    Scene scene =
        scene_of(R"("mesh": "ring.obj", "surface": "auto")", R"(, "placement": "world")", tracks);
    AssetStore meshes;
    make_choices(scene, meshes);
    for (int frame = 1; frame <= 4; ++frame)
        EXPECT_EQ(scene_at(scene, frame).models[0].surface, Surface::smooth) << frame;
}

TEST_F(SceneChoices, AreMadeBeforeAPictureIs) {
    const auto hash = [&](const char* surface) {
        RenderReport report;
        return oracle::image_hash(render(
            shared_device(), scene_of(std::string(R"("mesh": "box.obj")") + surface), report));
    };
    const uint64_t chosen_hash = hash(R"(, "surface": "auto")");
    EXPECT_EQ(chosen_hash, hash(R"(, "surface": "exact")"));
    EXPECT_NE(chosen_hash, hash(R"(, "surface": "smooth")"));
}

}  // namespace
}  // namespace voxelume
