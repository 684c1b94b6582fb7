// SPDX-License-Identifier: Apache-2.0
// Warnings about worlds that the cache doesn't keep, and about objects without voxels.
#include "runtime/world/voxel_warnings.hpp"

#include <gmock/gmock.h>

namespace voxelume {
namespace {

using testing::HasSubstr;

/// A cache of 8 MB for what takes a millisecond and more.
ModelCache cache() {
    return ModelCache("unused", 8 << 20, 0.001).with_worlds();
}

}  // namespace

TEST(VoxelWarnings, CallOnlyAWorldWorthKeepingTooLarge) {
    EXPECT_EQ(cache().max_entry_bytes(), 4u << 20);
    EXPECT_TRUE(cache().is_too_large((4 << 20) + 1, 10));
    EXPECT_FALSE(cache().is_too_large(4 << 20, 10));
    EXPECT_FALSE(cache().is_too_large((4 << 20) + 1, 0.0005));  // it is made as quickly as read
    EXPECT_FALSE(ModelCache("unused", 8 << 20).is_too_large((4 << 20) + 1, 10));
    EXPECT_FALSE(ModelCache().with_worlds().is_too_large((4 << 20) + 1, 10));
}

TEST(VoxelWarnings, SayHowLargeACacheAWorldNeeds) {
    World world;
    world.where = SourcePlace("room.json", 3, 5, "world");
    std::vector<Warning> warnings;
    add_large_world(world, 5 << 20, 10, cache(), warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].kind, WarningKind::world_not_cached);
    EXPECT_EQ(warnings[0].where.text(), "room.json:3:5: world");
    EXPECT_THAT(warnings[0].text, HasSubstr("its voxels take 5.2 MB"));
    EXPECT_THAT(warnings[0].text, HasSubstr("set VOXELUME_CACHE_MB to 11 or more"));
    add_large_world(world, 5 << 20, 10, cache(), warnings);
    EXPECT_EQ(warnings.size(), 1u);
    add_large_world(world, 1000, 10, cache(), warnings);
    EXPECT_EQ(warnings.size(), 1u);
}

TEST(VoxelWarnings, SayWhySolidsAndMeshesBecameNoVoxel) {
    Scene scene;
    scene.models.resize(2);
    for (Model& model : scene.models) model.surface = Surface::smooth;
    scene.models[0].solid = Solid();
    scene.objects.resize(2);
    scene.objects[1].model = 1;
    scene.objects[0].where = SourcePlace("room.json", 7, 5, "objects[0]");
    scene.objects[1].where = SourcePlace("room.json", 8, 5, "objects[1]");
    const BrickGrid empty;
    std::vector<PlacedObject> placed(2);
    for (uint32_t i = 0; i < 2; ++i) placed[i].object = i, placed[i].grid = &empty;
    std::vector<Warning> warnings;
    add_empty_objects(scene, placed, warnings);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_THAT(warnings[0].text, HasSubstr("it holds the middle of no voxel"));
    EXPECT_THAT(warnings[0].text, testing::Not(HasSubstr("its faces turn inwards")));
    EXPECT_THAT(warnings[1].text, HasSubstr("its faces turn inwards"));
}

TEST(VoxelWarnings, NameObjectsWhoseGridStoresNoBrick) {
    Scene scene;
    scene.models.emplace_back();
    scene.objects.resize(2);
    scene.objects[0].name = "thing";
    scene.objects[0].where = SourcePlace("room.json", 7, 5, "objects[0]");
    scene.objects[1].where = SourcePlace("room.json", 8, 5, "objects[1]");
    BrickGrid full, empty;
    full.brick_count = 1;
    std::vector<PlacedObject> placed(2);
    placed[0].grid = &empty;
    placed[1].grid = &full;
    placed[1].object = 1;
    std::vector<Warning> warnings;
    add_empty_objects(scene, placed, warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].kind, WarningKind::no_voxels);
    EXPECT_EQ(warnings[0].where.text(), "room.json:7:5: objects[0]");
    EXPECT_THAT(warnings[0].text, HasSubstr("\"thing\" became no voxel, so nothing shows it"));
    add_all_objects(scene, placed, warnings);
    EXPECT_EQ(warnings.size(), 2u);
}

}  // namespace voxelume
