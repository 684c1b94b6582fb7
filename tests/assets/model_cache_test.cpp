// SPDX-License-Identifier: Apache-2.0
// Models from the cache on disk give the same bits as without it, whatever happens to its files.
#include "runtime/assets/model_cache.hpp"
#include "runtime/scene_file/read_scene.hpp"

#include <gmock/gmock.h>

#include <regex>
#include <set>

#include "runtime/opencl/source/kernel_source.hpp"
#include "runtime/render/renderer.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/setting.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

/// A tetrahedron with colours and two groups, whose bytes can be changed by a digit.
std::string mesh_text(char digit) {
    return std::string("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 0.") + digit +
           " 0 0 0 1\nv 0 0 0.5 1 1 0\nusemtl a\nf 1 3 2\nf 1 2 4\nusemtl b\nf 2 3 4\nf 3 1 4\n";
}

struct Outcome {
    uint64_t hash = 0;
    WorldReport world;
    std::set<std::string> kernels;
};

class ModelCacheFiles : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        put_bytes(folder / "m.obj", mesh_text('7'));
    }

    Scene scene_of(const std::string& model) const {
        return parse_scene(R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-0.5, -0.5, -0.5], "max": [1.5, 1, 1]},
          "ambient": [0.1, 0.2, 0.3]},
"materials": {"m": {}, "n": {"color": [0.2, 0.9, 0.3]}},
"models": {"thing": {"mesh": "m.obj", )" +
                               model +
                               R"(}},
"objects": [{"model": "thing", "material": "m", "materials": {"b": "n"}}],
"lights": [{"type": "directional", "direction": [0.3, -1, 0.4]}],
"observer": {"position": [1.2, 1, -2], "look_at": [0.3, 0.2, 0.2],
             "display": {"shape": "pyramid", "angle": 30}},
"render": {"size": [48, 36]}})",
                           folder / "s.json", {});
    }

    ModelCache cache(double min_seconds = 0) const {
        return ModelCache(folder / "models", 64 << 20, min_seconds);
    }

    static Outcome show(const Scene& scene, const ModelCache& cache) {
        shared_device().counters().launches.clear();
        RenderReport report;
        const BuiltWorld world =
            WorldBuilder(shared_device(), false, AssetStore(cache)).build(scene, report.world);
        Outcome outcome;
        outcome.hash =
            oracle::image_hash(Renderer(shared_device(), false).new_image(scene, world, report));
        outcome.world = report.world;
        for (const auto& [name, count] : shared_device().counters().launches)
            outcome.kernels.insert(name);
        return outcome;
    }

    std::vector<fs::path> entries() const {
        std::vector<fs::path> paths;
        if (!fs::exists(folder / "models")) return paths;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder / "models"))
            paths.push_back(entry.path());
        std::ranges::sort(paths);
        return paths;
    }
};

/// The kernels that only the voxelize files contain.
std::set<std::string> voxelizing_kernels() {
    std::set<std::string> names, others;
    const std::regex pattern(R"(kernel void (\w+)\()");
    for (const auto& [file, content] : embedded_kernels()) {
        std::set<std::string>& kernels = file.starts_with("voxelize") ? names : others;
        const std::string text(content);
        for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i)
            kernels.insert((*i)[1]);
    }
    for (const std::string& name : others) names.erase(name);
    return names;
}

constexpr const char* kModels[] = {
    R"("voxel_size": 0.04, "surface": "smooth")",
    R"("voxel_size": 0.04, "surface": "cubes")",
    R"("voxel_size": 0.04, "surface": "cubes", "set": "solid")",
    R"("surface": "exact")",
    R"("voxel_size": 0.05, "morph": {"center": [0.2, 0.2, 0.1], "radius": 0.4,
                                     "amount": 0.25})",
};

TEST_F(ModelCacheFiles, AWarmRunShowsTheSameAndNeitherReadsNorVoxelizes) {
    const std::set<std::string> voxelizing = voxelizing_kernels();
    ASSERT_GT(voxelizing.size(), 5u);
    for (const char* model : kModels) {
        const Scene scene = scene_of(model);
        const Outcome without = show(scene, {}), cold = show(scene, cache());
        const Outcome warm = show(scene, cache());
        EXPECT_EQ(cold.hash, without.hash) << model;
        EXPECT_EQ(warm.hash, without.hash) << model;
        EXPECT_EQ(cold.world.voxelized, 1u) << model;
        EXPECT_EQ(cold.world.from_cache, 0u) << model;
        EXPECT_EQ(cold.world.meshes_read, 1u) << model;
        EXPECT_EQ(warm.world.voxelized, 0u) << model;
        EXPECT_EQ(warm.world.from_cache, 1u) << model;
        EXPECT_EQ(warm.world.meshes_read, 0u) << model;
        EXPECT_EQ(warm.world.triangles, 4u) << model;
        for (const std::string& kernel : warm.kernels)
            EXPECT_FALSE(voxelizing.contains(kernel)) << model << ": " << kernel;
    }
}

TEST_F(ModelCacheFiles, AThicknessIsKeptUntilTheWholeShapeIs) {
    const Model model = scene_of(kModels[0]).models.front();
    AssetStore first(cache()), second(cache()), third(cache());
    const double part = first.thickness_of(model).part;
    EXPECT_EQ(second.thickness_of(model).part, part);
    EXPECT_EQ(second.meshes_read(), 0u);
    EXPECT_GE(second.shape_of(model).creases.length, 0);
    EXPECT_EQ(second.meshes_read(), 1u);
    EXPECT_EQ(third.shape_of(model).creases.length, second.shape_of(model).creases.length);
    EXPECT_EQ(third.meshes_read(), 0u);
}

TEST_F(ModelCacheFiles, OtherParametersAreOtherEntries) {
    std::set<uint64_t> hashes;
    const std::string models[] = {
        R"("voxel_size": 0.04)",
        R"("voxel_size": 0.06)",  // finer than the world's, they would all be the world's
        R"("resolution": 20)",
        R"("voxel_size": 0.04, "surface": "cubes")",
        R"("voxel_size": 0.04, "surface": "cubes", "set": "thin")",
        R"("voxel_size": 0.04, "surface": "cubes", "set": "solid")",
        R"("surface": "exact")",
        R"("voxel_size": 0.04, "morph": {"center": [0.2, 0.2, 0.1], "radius": 0.4,
                                         "amount": 0.25})",
        R"("voxel_size": 0.04, "morph": {"center": [0.2, 0.2, 0.1], "radius": 0.4,
                                         "amount": 0.5})"};
    for (const std::string& model : models) {
        const Outcome outcome = show(scene_of(model), cache());
        EXPECT_EQ(outcome.world.from_cache, 0u) << model;
        EXPECT_EQ(outcome.hash, show(scene_of(model), {}).hash) << model;
        hashes.insert(outcome.hash);
    }
    EXPECT_GT(hashes.size(), 6u);
    Scene moved = scene_of(R"("surface": "exact")");
    moved.objects[0].world_from_object[3].x += 0.01;
    EXPECT_EQ(show(moved, cache()).world.from_cache, 0u) << "an exact object's place counts";
}

TEST_F(ModelCacheFiles, ChangedBytesUnderTheSameNameAndTimeAreSeen) {
    const std::string model = R"("voxel_size": 0.04)";
    const auto time = fs::last_write_time(folder / "m.obj");
    const Outcome before = show(scene_of(model), cache());
    put_bytes(folder / "m.obj", mesh_text('6'));
    fs::last_write_time(folder / "m.obj", time);
    const Outcome after = show(scene_of(model), cache());
    EXPECT_EQ(after.world.from_cache, 0u);
    EXPECT_NE(after.hash, before.hash);
    EXPECT_EQ(after.hash, show(scene_of(model), {}).hash);
    put_bytes(folder / "m.obj", mesh_text('7'));
    EXPECT_EQ(show(scene_of(model), cache()).world.from_cache, 1u) << "the first is still there";
}

TEST_F(ModelCacheFiles, TheSameBytesUnderAnotherNameAreTheSameModel) {
    const std::string model = R"("voxel_size": 0.04)";
    show(scene_of(model), cache());
    fs::create_directory(folder / "b");
    fs::rename(folder / "m.obj", folder / "b" / "other.obj");
    Scene scene;
    {
        put_bytes(folder / "m.obj", "");
        scene = scene_of(model);
    }
    scene.models[0].mesh = folder / "b" / "other.obj";
    EXPECT_EQ(show(scene, cache()).world.from_cache, 1u);
}

TEST_F(ModelCacheFiles, DamagedAndTruncatedEntriesAreMadeAgain) {
    const Scene scene = scene_of(kModels[0]);
    const uint64_t expected = show(scene, cache()).hash;
    ASSERT_EQ(entries().size(), 2u);
    for (const fs::path& entry : entries()) {
        const std::string whole = bytes_of(entry);
        // The places lie in the header, in the sizes, in the frames and at the end.
        for (const double part : {0.0, 0.01, 0.05, 0.1, 0.3, 0.6, 0.9, 1.0}) {
            const size_t index = size_t(part * double(whole.size() - 1));
            std::string damaged = whole;
            damaged[index] = char(damaged[index] ^ 0x10);
            for (const std::string& bytes : {damaged, whole.substr(0, index)}) {
                put_bytes(entry, bytes);
                const Outcome outcome = show(scene, cache());
                EXPECT_EQ(outcome.hash, expected) << index;
                EXPECT_EQ(outcome.world.voxelized + outcome.world.from_cache, 1u);
                EXPECT_EQ(outcome.world.meshes_read, 1u) << index;
                EXPECT_EQ(bytes_of(entry), whole) << "it is made again";
            }
        }
    }
    EXPECT_EQ(show(scene, cache()).world.meshes_read, 0u);
}

TEST_F(ModelCacheFiles, WhatIsQuicklyMadeIsNotKept) {
    show(scene_of(kModels[0]), cache(1e6));
    EXPECT_TRUE(entries().empty());
}

TEST_F(ModelCacheFiles, ItsSizeIsBounded) {
    const ModelCache small(folder / "models", 100000, 0);
    uint64_t written = 0;
    for (int i = 0; i < 40; ++i) {
        const Scene scene = scene_of(fmt::format(R"("voxel_size": {})", 1 / (16 + 0.19 * i)));
        const uint64_t hash = show(scene, small).hash;
        if (i % 8 == 0) {
            EXPECT_EQ(hash, show(scene, {}).hash);
        }
        uint64_t bytes = 0;
        for (const fs::path& entry : entries()) bytes += fs::file_size(entry);
        EXPECT_LE(bytes, 100000u);
        written = std::max(written, bytes);
    }
    EXPECT_GT(written, 50000u) << "nothing was kept";
    EXPECT_LT(entries().size(), 35u) << "nothing was dropped";
}

TEST_F(ModelCacheFiles, AModelThatTakesMoreThanAnEighthOfItIsKeptWhenItIsMadeAgain) {
    const Scene scene = scene_of(R"("resolution": 16)");
    const auto size = [](const fs::path& entry) { return fs::file_size(entry); };
    show(scene, cache());
    const uint64_t largest = size(std::ranges::max(entries(), {}, size));
    for (const auto& [runs, of, kept] : {std::tuple(1, 10, 1), {1, 6, 0}, {2, 6, 1}, {3, 1, 0}}) {
        fs::remove_all(folder / "models");
        const ModelCache small(folder / "models", uint64_t(of) * largest, 0);
        for (int run = 0; run < runs; ++run) show(scene, small);
        EXPECT_EQ(std::ranges::count(entries(), largest, size), kept) << runs << of;
    }
}

TEST_F(ModelCacheFiles, AFolderThatCannotBeWrittenKeepsNothing) {
    put_bytes(folder / "models", "in the way");
    const Scene scene = scene_of(kModels[0]);
    EXPECT_EQ(show(scene, cache()).hash, show(scene, {}).hash);
    EXPECT_EQ(bytes_of(folder / "models"), "in the way");
}

TEST_F(ModelCacheFiles, ExactObjectsThatMoveAreNotKept) {
    Scene scene = scene_of(R"("surface": "exact")");
    scene.objects[0].moves = true;
    scene.objects[0].placement = Placement::world;
    show(scene, cache());
    EXPECT_EQ(entries().size(), 1u) << "the mesh's summary";
    EXPECT_EQ(show(scene, cache()).world.voxelized, 1u);
}

TEST_F(ModelCacheFiles, AMeshThatChangesBetweenItsSummaryAndItsVoxelsIsAnError) {
    const Scene scene = scene_of(kModels[0]);
    AssetStore meshes(cache());
    show(scene, cache());
    ASSERT_NE(meshes.summary_of(scene.models[0]), nullptr);
    EXPECT_EQ(meshes.meshes_read(), 0u);
    put_bytes(folder / "m.obj", mesh_text('6'));
    const Error error = error_of([&] { meshes.mesh_of(scene.models[0]); });
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_THAT(error.what(), testing::HasSubstr("changed while it was being read"));
}

TEST(ModelCacheOfTheUser, IsBelowTheCacheFolderAndAsLargeAsAsked) {
    const Setting no_folder("VOXELUME_CACHE_DIR", "");
    EXPECT_FALSE(ModelCache::of_user().is_open());
    const Setting a_folder("VOXELUME_CACHE_DIR", "/proc/none");
    EXPECT_TRUE(ModelCache::of_user().is_open());
    const Setting no_bytes("VOXELUME_CACHE_MB", "0");
    EXPECT_FALSE(ModelCache::of_user().is_open());
    for (const char* text : {"-1", "4 GB", "1e3", "99999999999999999999"}) {
        const Setting bytes("VOXELUME_CACHE_MB", text);
        const Error error = error_of([] { ModelCache::of_user(); });
        EXPECT_EQ(error.kind(), ErrorKind::usage) << text;
        EXPECT_THAT(error.what(), testing::HasSubstr(text));
    }
}

}  // namespace
}  // namespace voxelume
