// Worlds from the cache on disk that have more objects than are in reach.
#include "runtime/analysis/reach.hpp"
#include "runtime/world/world_source.hpp"
#include "tests/analysis/reach_scene.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using reach_scene::hash_of_all;
using reach_scene::scene_of;

class ReachFiles : public FileTest {};

/// A ball in view of which every kind differs from those of the rest.
Scene scene_of_cubes_in_view() {
    Scene scene = scene_of();
    std::swap(scene.objects[0].model, scene.objects[1].model);
    for (Object& object : scene.objects) object.material = 1;
    scene.materials[2].reflection = 0.5f;
    scene.objects[3].material = 2;
    return scene;
}

TEST_F(ReachFiles, DecidesWhatIsMadeOfAWiderWorldInTheCache) {
    const Scene scene = scene_of_cubes_in_view();
    const uint64_t expected = hash_of_all(scene);
    const ModelCache cache = ModelCache(folder / "models", 64 << 20, 0).with_worlds();
    const auto show = [&](bool finds_reach) {
        MeshStore meshes(cache);
        const Scene shown = finds_reach ? with_objects_in_reach(scene, meshes) : scene;
        shared_device().counters().launches.clear();
        RenderReport report;
        const FormedWorld world =
            WorldFormer(shared_device(), false, std::move(meshes)).form(shown, report.world);
        EXPECT_EQ(world.pyramid.fields.empty(), finds_reach);
        EXPECT_EQ(world.pyramid.solids.empty(), finds_reach);
        const Image image = Renderer(shared_device(), false).new_image(shown, world, report);
        EXPECT_EQ(oracle::image_hash(image), expected);
        EXPECT_EQ(report.world.out_of_reach, finds_reach ? 4u : 0u);
        EXPECT_EQ(shared_device().counters().launches.contains("scatter_rays"), !finds_reach);
        return report;
    };
    EXPECT_FALSE(show(false).world.is_from_cache);
    const RenderReport wide = show(true);
    EXPECT_TRUE(wide.world.is_from_cache);
    EXPECT_EQ(wide.world.voxelized, 0u);
    // A narrow one comes first.
    MeshStore none;
    RenderReport report;
    const Scene narrow = with_objects_in_reach(scene, none);
    const Pyramid world = form_world(shared_device(), narrow, report.world);
    MeshStore meshes(cache);
    cache.keep(world_source(narrow, meshes), world, 1);
    const RenderReport taken = show(true);
    EXPECT_TRUE(taken.world.is_from_cache);
    EXPECT_EQ(taken.voxels, world.voxel_count);
    EXPECT_LT(taken.voxels, wide.voxels);
}

TEST_F(ReachFiles, WithADamagedWiderWorldANarrowOneIsMadeAndKept) {
    const Scene scene = scene_of_cubes_in_view();
    const ModelCache cache = ModelCache(folder / "models", 64 << 20, 0).with_worlds();
    WorldReport report;
    WorldFormer(shared_device(), false, MeshStore(cache)).form(scene, report);
    for (const auto& entry : std::filesystem::directory_iterator(folder / "models"))
        std::filesystem::resize_file(entry.path(), entry.file_size() / 2);
    for (const bool is_kept : {false, true}) {
        MeshStore meshes(cache);
        const Scene shown = with_objects_in_reach(scene, meshes);
        WorldReport narrow;
        WorldFormer(shared_device(), false, std::move(meshes)).form(shown, narrow);
        EXPECT_EQ(narrow.is_from_cache, is_kept);
    }
    RenderReport all;
    const FormedWorld world =
        WorldFormer(shared_device(), false, MeshStore(cache)).form(scene, all.world);
    EXPECT_FALSE(all.world.is_from_cache);
}

}  // namespace
}  // namespace voxelume
