// SPDX-License-Identifier: Apache-2.0
// Worlds in the cache on disk that hold more objects than are potentially visible.
#include "runtime/analysis/culling.hpp"
#include "runtime/world/world_source.hpp"
#include "tests/analysis/culling_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/finned_ball.hpp"

namespace voxelume {
namespace {

using culling_scene::hash_of_all;
using culling_scene::scene_of;

class CullingFiles : public FileTest {};

/// A scene whose visible ball differs in every kind of surface and material from the other objects.
Scene scene_of_cubes_in_view() {
    Scene scene = scene_of();
    std::swap(scene.objects[0].model, scene.objects[1].model);
    for (Object& object : scene.objects) object.material = 1;
    scene.materials[2].reflection = 0.5f;
    scene.objects[3].material = 2;
    return scene;
}

TEST_F(CullingFiles, DecidesWhatIsMadeOfAWiderWorldInTheCache) {
    const Scene scene = scene_of_cubes_in_view();
    const uint64_t expected = hash_of_all(scene);
    const ModelCache cache = ModelCache(folder / "models", 64 << 20, 0).with_worlds();
    const auto show = [&](bool finds_visible) {
        AssetStore meshes(cache);
        const Scene shown = finds_visible ? with_culling(scene, meshes) : scene;
        shared_device().counters().launches.clear();
        RenderReport report;
        const BuiltWorld world =
            WorldBuilder(shared_device(), false, std::move(meshes)).build(shown, report.world);
        EXPECT_EQ(world.pyramid.fields.empty(), finds_visible);
        EXPECT_EQ(world.pyramid.solids.empty(), finds_visible);
        const Image image = Renderer(shared_device(), false).new_image(shown, world, report);
        EXPECT_EQ(oracle::image_hash(image), expected);
        EXPECT_EQ(report.world.culled, finds_visible ? 4u : 0u);
        EXPECT_EQ(shared_device().counters().launches.contains("scatter_rays"), !finds_visible);
        return report;
    };
    EXPECT_FALSE(show(false).world.is_from_cache);
    const RenderReport wide = show(true);
    EXPECT_TRUE(wide.world.is_from_cache);
    EXPECT_EQ(wide.world.voxelized, 0u);
    // If the cache also holds a narrower world, that one is taken first.
    AssetStore none;
    RenderReport report;
    const Scene narrow = with_culling(scene, none);
    const Pyramid world = build_world(shared_device(), narrow, report.world);
    AssetStore meshes(cache);
    cache.keep(world_source(narrow, meshes), world, 1);
    const RenderReport taken = show(true);
    EXPECT_TRUE(taken.world.is_from_cache);
    EXPECT_EQ(taken.voxels, world.voxel_count);
    EXPECT_LT(taken.voxels, wide.voxels);
}

TEST_F(CullingFiles, LeavesTrianglesOfMeshesThatAreExactInPartsInAWiderWorld) {
    write_obj(folder / "fin.obj", finned_ball(0.012, 0.6, 48));
    Scene scene = scene_of(R"({"type": "point", "position": [0, 3, -3]})");
    scene.models[0].solid.reset();
    scene.models[0].mesh = folder / "fin.obj";
    scene.models[0].thin_edge = 0.05;
    for (size_t i : {1, 2, 4}) scene.objects[i].visible = false;
    ASSERT_TRUE(thin_part_of(scene.models[0]));
    const uint64_t expected = hash_of_all(scene);
    const ModelCache cache = ModelCache(folder / "models", 64 << 20, 0).with_worlds();
    for (const bool finds_visible : {false, true}) {
        AssetStore meshes(cache);
        const Scene shown = finds_visible ? with_culling(scene, meshes) : scene;
        RenderReport report;
        const BuiltWorld world =
            WorldBuilder(shared_device(), false, std::move(meshes)).build(shown, report.world);
        EXPECT_EQ(report.world.is_from_cache, finds_visible);
        EXPECT_FALSE(world.pyramid.triangles.empty());
        const Image image = Renderer(shared_device(), false).new_image(shown, world, report);
        EXPECT_EQ(oracle::image_hash(image), expected);
    }
}

TEST_F(CullingFiles, WithADamagedWiderWorldANarrowOneIsMadeAndKept) {
    const Scene scene = scene_of_cubes_in_view();
    const ModelCache cache = ModelCache(folder / "models", 64 << 20, 0).with_worlds();
    WorldReport report;
    WorldBuilder(shared_device(), false, AssetStore(cache)).build(scene, report);
    for (const auto& entry : std::filesystem::directory_iterator(folder / "models"))
        std::filesystem::resize_file(entry.path(), entry.file_size() / 2);
    for (const bool is_kept : {false, true}) {
        AssetStore meshes(cache);
        const Scene shown = with_culling(scene, meshes);
        WorldReport narrow;
        WorldBuilder(shared_device(), false, std::move(meshes)).build(shown, narrow);
        EXPECT_EQ(narrow.is_from_cache, is_kept);
    }
    RenderReport all;
    const BuiltWorld world =
        WorldBuilder(shared_device(), false, AssetStore(cache)).build(scene, all.world);
    EXPECT_FALSE(all.world.is_from_cache);
}

}  // namespace
}  // namespace voxelume
