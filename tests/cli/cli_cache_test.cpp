// SPDX-License-Identifier: Apache-2.0
// The cache of models as programs use it, several programs at once too.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "runtime/base/files/disk_cache.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

class CliCache : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        write_obj(folder / "ring.obj", wavy_ring(150, 80));
        put_bytes(folder / "s.json", R"({"voxelume": 1,
"world": {"voxel_size": 0.02, "bounds": {"min": [-0.6, -0.6, -0.6], "max": [0.6, 0.6, 0.6]}},
"models": {"ring": {"mesh": "ring.obj", "surface": "smooth"}},
"objects": [{"model": "ring"}],
"lights": [{"type": "directional", "direction": [0.3, -1, 0.4]}],
"observer": {"position": [0.5, 1, -2], "look_at": [0, 0, 0],
             "display": {"shape": "pyramid", "angle": 30}},
"render": {"size": [40, 30]}})");
        const fs::path shared = cache_folder();
        cache_ = folder / "cache";
        if (!shared.empty()) cache_ = shared.string() + "." + folder.filename().string();
        fs::create_directories(cache_);
        if (!shared.empty()) link_files(shared / "programs", cache_ / "programs");
    }

    /// Other tests take the kernels that this one compiled.
    void TearDown() override {
        if (!cache_folder().empty()) link_files(cache_ / "programs", cache_folder() / "programs");
        fs::remove_all(cache_);
        ProgramTest::TearDown();
    }

    /// Kernels come from the folder that all tests share. Its files get hard links in the test's
    /// own folder next to it, because the program follows no link to a folder.
    static void link_files(const fs::path& from, const fs::path& to) {
        std::error_code exists;
        fs::create_directories(from);
        fs::create_directories(to);
        for (const fs::directory_entry& entry : fs::directory_iterator(from))
            if (entry.is_regular_file() && !entry.path().filename().string().starts_with('.'))
                fs::create_hard_link(entry.path(), to / entry.path().filename(), exists);
    }

    std::string render(const std::string& name, const std::string& options = "") const {
        const std::string line = fmt::format(
            "cd '{}' && VOXELUME_CACHE_DIR='{}' '{}' render s.json -q --float -o {}.exr "
            "--stats-json {}.json {} >/dev/null",
            folder.string(), cache_.string(), VXL_BINARY, name, name, options);
        EXPECT_EQ(std::system(line.c_str()), 0) << line;
        return bytes_of(folder / (name + ".exr"));
    }

    nlohmann::json frames(const std::string& name) const {
        return nlohmann::json::parse(bytes_of(folder / (name + ".json"))).at("frames");
    }
    nlohmann::json frame(const std::string& name) const { return frames(name).at(0); }

    void replace(const std::string& before, const std::string& after) const {
        std::string text = bytes_of(folder / "s.json");
        text.replace(text.find(before), before.size(), after);
        put_bytes(folder / "s.json", text);
    }

    /// Adds tracks that move the observer around in three frames.
    void turn_observer() const {
        std::string text = bytes_of(folder / "s.json");
        text.replace(text.find("\"render\""), 8, R"("animation": {"frames": 3, "tracks": [
            {"target": "observer.position", "keys": [{"frame": 1, "value": [0.5, 1, -2]},
                                                     {"frame": 3, "value": [2, 1, 0.5]}]}]},
            "render")");
        put_bytes(folder / "s.json", text);
    }

    fs::path cache_;
};

TEST_F(CliCache, ASecondRunTakesTheModelFromIt) {
    const std::string cold = render("cold"), warm = render("warm");
    EXPECT_TRUE(cold == warm);
    EXPECT_EQ(frame("cold")["meshes_read"], 1);
    EXPECT_EQ(frame("cold")["voxelized"], 1);
    EXPECT_EQ(frame("warm")["meshes_read"], 0);
    EXPECT_EQ(frame("warm")["voxelized"], 0);
    EXPECT_EQ(frame("warm")["world_from_cache"], true);
    EXPECT_GT(frame("cold")["seconds"]["cache"], 0.0);
    EXPECT_EQ(frame("warm")["seconds"]["cache"], 0.0);
}

TEST_F(CliCache, ASecondRunOfAMovingObserverReadsTheWorldAndFormsNothing) {
    turn_observer();
    for (const std::string name : {"cold", "warm"}) {
        render(name + ".#", "--frames 1-3");
        const nlohmann::json frames = this->frames(name + ".#");
        EXPECT_EQ(frames[0]["world_from_cache"], name == "warm");
        EXPECT_EQ(frames[0]["voxelized"], name == "warm" ? 0 : 1);
        EXPECT_EQ(frames[0]["painted_bricks"] > 0, name == "cold");
        for (const size_t later : {1, 2}) {
            EXPECT_EQ(frames[later]["world"], "kept");
            EXPECT_EQ(frames[later]["world_from_cache"], false);
        }
    }
    for (const char* frame : {"1", "2", "3"})
        EXPECT_TRUE(bytes_of(folder / fmt::format("cold.{}.exr", frame)) ==
                    bytes_of(folder / fmt::format("warm.{}.exr", frame)));
}

TEST_F(CliCache, AMeshIsReadOnceForAllDevices) {
    turn_observer();
    if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "a device that can't be cut";
    render("f.#", "--frames 1-3 --device all/2 --no-cache");
    int meshes_read = 0;
    for (const nlohmann::json& frame : frames("f.#")) meshes_read += int(frame["meshes_read"]);
    EXPECT_EQ(meshes_read, 1);
}

TEST_F(CliCache, AnotherPlaceIsAnotherWorldOfTheSameModel) {
    replace(R"("surface": "smooth")", R"("surface": "cubes")");
    render("first");
    replace(R"("model": "ring")", R"("model": "ring", "turn": [0, 0, 9])");
    const std::string moved = render("moved"), without = render("without", "--no-cache");
    EXPECT_TRUE(moved == without);
    EXPECT_EQ(frame("moved")["world_from_cache"], false);
    EXPECT_EQ(frame("moved")["models_from_cache"], 1);
}

TEST_F(CliCache, ASmoothModelIsVoxelizedAtEachPlaceInTheWorld) {
    render("first");
    replace(R"("model": "ring")", R"("model": "ring", "turn": [0, 0, 9])");
    render("moved");
    EXPECT_EQ(frame("moved")["models_from_cache"], 0);
    EXPECT_EQ(frame("moved")["voxelized"], 1);
    replace(R"("bounds": {"min": [-0.6, -0.6, -0.6], "max": [0.6)",
            R"("bounds": {"min": [-0.6, -0.6, -0.6], "max": [0.64)");
    const std::string wider = render("wider"), without = render("without", "--no-cache");
    EXPECT_TRUE(wider == without);
    EXPECT_EQ(frame("wider")["world_from_cache"], false);
    EXPECT_EQ(frame("wider")["models_from_cache"], 1) << "its part of the lattice is the same";
}

TEST_F(CliCache, NoCacheLeavesTheFolderUntouched) {
    render("a", "--no-cache");
    EXPECT_FALSE(fs::exists(cache_ / "models"));
    render("b");
    render("c", "--no-cache");
    EXPECT_EQ(frame("c")["voxelized"], 1);
    EXPECT_EQ(frame("c")["models_from_cache"], 0);
}

TEST_F(CliCache, ProcessesShareAColdFolder) {
    const std::string expected = render("alone", "--no-cache");
    std::vector<std::thread> threads;
    for (int i = 0; i < 5; ++i) threads.emplace_back([this, i] { render(fmt::format("p{}", i)); });
    for (std::thread& thread : threads) thread.join();
    for (int i = 0; i < 5; ++i)
        EXPECT_TRUE(bytes_of(folder / fmt::format("p{}.exr", i)) == expected) << i;
    int entries = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(cache_ / "models")) {
        EXPECT_FALSE(entry.path().filename().string().starts_with('.'));
        ++entries;
    }
    EXPECT_EQ(entries, 4) << "summary, shape, model and world";
    render("warm");
    EXPECT_EQ(frame("warm")["world_from_cache"], true);
}

}  // namespace
}  // namespace voxelume
