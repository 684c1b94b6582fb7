// SPDX-License-Identifier: Apache-2.0
// Worlds from the cache on disk are found again by everything that their voxels are made of, and by
// nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "runtime/render/renderer.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/world/world_source.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/support/writers/array_writer.hpp"

namespace voxelume {
namespace {

constexpr const char* kCachedScene = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-0.5, -0.5, -0.5], "max": [1.5, 1, 1]},
          "ambient": [0.1, 0.2, 0.3]},
"materials": {"m": {}, "n": {"color": [0.2, 0.9, 0.3]}},
"models": {"thing": {"mesh": "m.obj", "voxel_size": 0.04, "surface": "SURFACE"},
           "ball": {"shape": "sphere", "radius": 0.3, "voxel_size": 0.05, "surface": "SURFACE"}},
"objects": [{"name": "a", "model": "thing", "material": "m"},
            {"name": "b", "model": "ball", "material": "n", "position": [0.3, 0.2, 0.1]}],
"lights": [{"type": "directional", "direction": [0.3, -1, 0.4]}],
"observer": {"position": [1.2, 1, -2], "look_at": [0.3, 0.2, 0.2],
             "display": {"shape": "pyramid", "angle": 30}},
"render": {"size": [48, 36]}})";

constexpr const char* kCachedMesh =
    "v 0 0 0\nv 1 0 0\nv 0 0.7 0\nv 0 0 0.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// A text in the scene, and the text that replaces it.
struct Change {
    const char* from = "";
    const char* to = "";
};

std::string text_with(std::string text, const std::string& from, const std::string& to) {
    for (size_t at = text.find(from); !from.empty() && at != std::string::npos;
         at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

struct Outcome {
    uint64_t hash = 0;
    WorldReport world;
    std::map<std::string, uint64_t> launches;
};

class WorldCacheFiles : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        put_bytes(folder / "m.obj", kCachedMesh);
    }

    Scene scene(const std::string& surface, const Change& change = {}) const {
        const std::string text = text_with(kCachedScene, "SURFACE", surface);
        const std::string changed = text_with(text, change.from, change.to);
        EXPECT_TRUE(*change.from == 0 || changed != text) << change.from;
        return parse_scene(changed, folder / "s.json", {});
    }

    ModelCache cache_of(uint64_t bytes) const {
        return ModelCache(folder / "models", bytes, 0).with_worlds();
    }

    Outcome show(const Scene& scene, bool from_disk = true) const {
        return show(scene, from_disk ? cache_of(64 << 20) : ModelCache());
    }

    Outcome show(const Scene& scene, const ModelCache& cache) const {
        shared_device().counters().launches.clear();
        RenderReport report;
        const BuiltWorld world =
            WorldBuilder(shared_device(), false, AssetStore(cache)).build(scene, report.world);
        Outcome outcome;
        outcome.hash =
            oracle::image_hash(Renderer(shared_device(), false).new_image(scene, world, report));
        outcome.world = report.world;
        outcome.launches = shared_device().counters().launches;
        return outcome;
    }
};

TEST_F(WorldCacheFiles, AWarmRunShowsTheSameAndPlacesNothing) {
    for (const char* surface : {"smooth", "cubes", "exact"}) {
        const uint64_t without = show(scene(surface), false).hash;
        const Outcome cold = show(scene(surface)), warm = show(scene(surface));
        EXPECT_EQ(cold.hash, without) << surface;
        EXPECT_EQ(warm.hash, without) << surface;
        EXPECT_FALSE(cold.world.is_from_cache) << surface;
        EXPECT_TRUE(warm.world.is_from_cache) << surface;
        EXPECT_EQ(warm.world.voxelized + warm.world.from_cache + warm.world.meshes_read, 0u);
        EXPECT_GT(cold.launches.count("write_united") + cold.launches.count("write_voxels"), 0u);
        for (const char* kernel : {"mark_near_leaves", "classify_bricks", "paint_distances",
                                   "paint_cubes", "mark_voxels", "write_voxels", "write_united"})
            EXPECT_EQ(warm.launches.count(kernel), 0u) << surface << ": " << kernel;
    }
}

// One that is seen once would displace other entries for nothing.
TEST_F(WorldCacheFiles, ALargeWorldIsKeptWhenItIsMadeForTheSecondTime) {
    const Scene shown = scene("smooth");
    show(shown);
    uint64_t largest = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "models"))
        largest = std::max<uint64_t>(largest, entry.file_size());
    ASSERT_GT(largest, 10'000u);
    std::filesystem::remove_all(folder / "models");
    for (const bool is_kept : {false, false, true, true})
        EXPECT_EQ(show(shown, cache_of(8 * largest)).world.is_from_cache, is_kept);
    std::filesystem::remove_all(folder / "models");
    for (int run = 0; run < 4; ++run)
        EXPECT_FALSE(show(shown, cache_of(largest)).world.is_from_cache);
}

TEST_F(WorldCacheFiles, WhatTheVoxelsAreMadeOfIsAnotherWorld) {
    const Change changes[] = {
        {"\"position\": [0.3", "\"position\": [0.35"},
        {"\"material\": \"n\"", "\"material\": \"m\""},
        {"\"radius\": 0.3", "\"radius\": 0.31"},
        {"\"model\": \"ball\",", "\"model\": \"ball\", \"scale\": 1.1,"},
        {"\"model\": \"ball\",", "\"model\": \"ball\", \"priority\": 1,"},
        {"\"model\": \"ball\",", "\"model\": \"ball\", \"visible\": false,"},
        {"\"voxel_size\": 0.05, \"bounds\"", "\"voxel_size\": 0.06, \"bounds\""},
        {"[1.5, 1, 1]", "[1.5, 1, 1.1]"},
        {"\"shape\": \"sphere\"", "\"shape\": \"capsule\", \"height\": 0.2"},
        {"\"mesh\": \"m.obj\",",
         R"("mesh": "m.obj", "morph": {"center": [0, 0, 0], "radius": 0.4, "amount": 0.2},)"},
    };
    for (const char* surface : {"smooth", "cubes", "exact"}) {
        show(scene(surface));
        for (const Change& change : changes) {
            const Scene changed = scene(surface, change);
            const Outcome outcome = show(changed);
            EXPECT_FALSE(outcome.world.is_from_cache) << surface << ": " << change.to;
            EXPECT_EQ(outcome.hash, show(changed, false).hash) << surface << ": " << change.to;
            EXPECT_EQ(outcome.hash, show(changed).hash) << surface << ": " << change.to;
        }
    }
    put_bytes(folder / "m.obj", text_with(kCachedMesh, "0.7", "0.6"));
    EXPECT_FALSE(show(scene("smooth")).world.is_from_cache) << "other bytes of the mesh";
}

TEST_F(WorldCacheFiles, FilesOfVoxelsAreKnownByTheirContent) {
    const auto put_cells = [&](const std::string& cells, const char* shape = "2, 2, 2") {
        put_bytes(folder / "m.npy", npy_bytes("|u1", shape, cells));
    };
    const Change of_voxels = {R"("mesh": "m.obj", "voxel_size": 0.04, "surface": "smooth")",
                              R"("voxels": "m.npy", "unit": "ft")"};
    const std::string ones("\1\0\2\1\0\1\1\3", 8), others("\1\0\2\1\2\1\1\3", 8);
    put_cells(ones);
    const Scene shown = scene("smooth", of_voxels);
    const uint64_t without = show(shown, false).hash;
    EXPECT_FALSE(show(shown).world.is_from_cache);
    const Outcome warm = show(shown);
    EXPECT_TRUE(warm.world.is_from_cache);
    EXPECT_EQ(warm.hash, without);
    EXPECT_EQ(warm.launches.count("paint_cubes") + warm.launches.count("write_voxels"), 0u);
    put_cells(others);
    EXPECT_FALSE(show(shown).world.is_from_cache) << "other cells";
    EXPECT_EQ(show(shown).hash, show(shown, false).hash);
    const Scene larger = scene("smooth", {of_voxels.from, R"("voxels": "m.npy", "unit": "in")"});
    EXPECT_FALSE(show(larger).world.is_from_cache) << "larger cells";
    for (const char* color : {"\x10\x20\x30\xff", "\x10\x20\x31\xff", "\x10\x20\x31\x80"}) {
        put_cells(color, "1, 1, 1, 4");
        EXPECT_FALSE(show(shown).world.is_from_cache) << "another colour or opacity";
        EXPECT_TRUE(show(shown).world.is_from_cache);
        EXPECT_EQ(show(shown).hash, show(shown, false).hash);
    }
    // Light that goes into bricks that are full meets what is inside.
    put_cells(std::string(4096, '\1'), "16, 16, 16");
    show(shown);
    Scene clear = shown;
    for (Material& material : clear.materials) material.opacity = 0.5;
    EXPECT_FALSE(show(clear).world.is_from_cache) << "one that lets light through";
    EXPECT_EQ(show(clear).hash, show(clear, false).hash);
    std::filesystem::remove(folder / "m.npy");
    EXPECT_THROW(show(shown), Error);
}

TEST_F(WorldCacheFiles, LightsMaterialsAndObserversKeepIt) {
    show(scene("smooth"));
    for (const Change& change :
         {Change{"[0.3, -1, 0.4]", "[0.1, -1, 0.4]"}, Change{"[0.2, 0.9, 0.3]", "[0.9, 0.2, 0.3]"},
          Change{"\"look_at\": [0.3", "\"look_at\": [0.2"},
          Change{"\"size\": [48, 36]", "\"size\": [50, 36]"},
          Change{"\"m\": {}", "\"m\": {\"reflection\": 0.5}"}}) {
        const Scene changed = scene("smooth", change);
        const Outcome outcome = show(changed);
        EXPECT_TRUE(outcome.world.is_from_cache) << change.to;
        EXPECT_EQ(outcome.hash, show(changed, false).hash) << change.to;
    }
}

/// The values of a track at frames 1 and 3.
struct Movement {
    const char* target;
    const char* from;
    const char* to;
    const char* placement = "world";  ///< of the ball
};

class MovingWorldFiles : public WorldCacheFiles {
  protected:
    Scene moving_scene(const Movement& motion) const {
        std::string text = text_with(kCachedScene, "SURFACE", "smooth");
        text = text_with(text, "\"name\": \"b\"",
                         fmt::format(R"("name": "b", "placement": "{}")", motion.placement));
        const std::string animation = fmt::format(
            R"("animation": {{"frames": 3, "tracks": [{{"target": "{}", "keys": [
                {{"frame": 1, "value": {}}}, {{"frame": 3, "value": {}}}]}}]}}, "render":)",
            motion.target, motion.from, motion.to);
        return parse_scene(text_with(text, "\"render\":", animation), folder / "s.json", {});
    }
    ModelCache cache() const { return ModelCache(folder / "models", 64 << 20, 0).with_worlds(); }
};

TEST_F(MovingWorldFiles, AreNotKeptWhereTracksChangeTheirVoxels) {
    AssetStore meshes(cache());
    for (const Movement& motion :
         {Movement{"objects.b.position", "[0.3, 0.2, 0.1]", "[0.2, 0.2, 0.1]"},
          Movement{"objects.b.visible", "true", "false"},
          Movement{"objects.b.model", "\"ball\"", "\"thing\""},
          Movement{"objects.b.material", "\"m\"", "\"n\""},
          Movement{"models.ball.radius", "0.3", "0.2"}})
        EXPECT_EQ(world_source(moving_scene(motion), meshes), "") << motion.target;
}

TEST_F(MovingWorldFiles, AreThoseOfAStillWorldWhereTracksLeaveTheirVoxelsAlone) {
    AssetStore meshes(cache());
    const std::string still = world_source(this->scene("smooth"), meshes);
    EXPECT_NE(still, "");
    for (const Movement& motion :
         {Movement{"observer.position", "[1.2, 1, -2]", "[-1.2, 1, -2]"},
          Movement{"observer.display.angle", "30", "20"},
          Movement{"lights[0].direction", "[0.3, -1, 0.4]", "[0, -1, 0.4]"},
          Movement{"materials.m.color", "[1, 0, 0]", "[0, 1, 0]"},
          Movement{"world.ambient", "[0, 0, 0]", "[1, 1, 1]"},
          Movement{"world.background", "[0, 0, 0]", "[1, 1, 1]"}})
        EXPECT_EQ(world_source(moving_scene(motion), meshes), still) << motion.target;
    // The world is cached without the ball, which is an instance.
    const Movement moves{"objects.b.position", "[0.3, 0.2, 0.1]", "[0.2, 0.2, 0.1]", "instance"};
    const Movement stretches{"models.ball.radius", "0.3", "0.2", "instance"};
    EXPECT_NE(world_source(moving_scene(moves), meshes), "");
    EXPECT_EQ(world_source(moving_scene(moves), meshes),
              world_source(moving_scene(stretches), meshes));
}

TEST_F(MovingWorldFiles, AreReadOnceForAllFrames) {
    const Movement motion{"objects.b.visible", "true", "false", "instance"};
    const Scene scene = moving_scene(motion);
    for (const bool is_warm : {false, true}) {
        WorldBuilder builder(shared_device(), true, AssetStore(cache()));
        Renderer renderer(shared_device());
        bool is_first = true;
        for (const int frame : {1, 3, 4, 1}) {
            const Scene now = scene_at(scene, frame);
            RenderReport report, alone;
            const BuiltWorld world = builder.build(now, report.world);
            EXPECT_EQ(oracle::image_hash(*renderer.image(now, world, report)),
                      oracle::image_hash(render(shared_device(), now, alone)));
            EXPECT_EQ(report.world.is_from_cache, is_warm && is_first) << frame;
            EXPECT_EQ(report.world.painted_bricks > 0, !is_warm && is_first) << frame;
            is_first = false;
        }
    }
}

TEST_F(WorldCacheFiles, DamagedEntriesAreMadeAgain) {
    const Scene scene = this->scene("smooth");
    const uint64_t expected = show(scene).hash;
    for (const double part : {0.0, 0.3, 0.9}) {
        for (const auto& entry : std::filesystem::directory_iterator(folder / "models"))
            std::filesystem::resize_file(entry.path(), uintmax_t(part * double(entry.file_size())));
        const Outcome outcome = show(scene);
        EXPECT_FALSE(outcome.world.is_from_cache) << part;
        EXPECT_EQ(outcome.hash, expected) << part;
        EXPECT_TRUE(show(scene).world.is_from_cache) << part;
    }
}

}  // namespace
}  // namespace voxelume
