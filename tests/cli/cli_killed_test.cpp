// SPDX-License-Identifier: Apache-2.0
// A program that is killed while it writes leaves whole files or none, and the next run removes
// what was half written.
#include <gmock/gmock.h>

#include <map>

#include "tests/cli/scene_program.hpp"

namespace voxelume {

class CliKilledTest : public SceneProgramTest {
  protected:
    /// The bytes of every file in `out` that isn't hidden, by name.
    std::map<std::string, std::string> files_of_output() const {
        std::map<std::string, std::string> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
            const std::string name = entry.path().filename();
            if (!name.starts_with('.')) files[name] = bytes_of(entry.path());
        }
        return files;
    }
    size_t count_of_output() const {
        const std::filesystem::directory_iterator files(folder / "out");
        return size_t(std::distance(begin(files), end(files)));
    }
};

TEST_F(CliKilledTest, LeavesWholeFilesOrNoneInEveryFormat) {
    write_scene([](Json& scene) {
        scene["observer"]["display"]["voxels"] = {96, 96, 96};
        scene["observer"]["display"]["layout"] = "lattice";
    });
    ASSERT_EQ(run("render scene.json --volume v.nrrd -q").exit_code, 0);
    for (const char* name : {"v.vdb", "v.nrrd", "v.raw", "v.ply", "v.kv6", "v.####.png", "v.planes",
                             "v.cplanes", "v.rgb332", "v.rgb565"}) {
        std::filesystem::create_directory(folder / "out");
        const std::string convert = fmt::format("convert v.nrrd out/{}", name);
        // In the foreground it doesn't kill itself, but waits until the program is dead.
        for (const char* seconds : {"0.005", "0.02", "0.04", "0.08"})
            run_line(fmt::format("timeout --foreground -s KILL {} voxelume {}", seconds, convert));
        const std::map<std::string, std::string> early = files_of_output();
        ASSERT_EQ(run(convert).exit_code, 0) << name;
        std::map<std::string, std::string> whole = files_of_output();
        for (const auto& [file, bytes] : early) EXPECT_TRUE(whole[file] == bytes) << file;
        EXPECT_EQ(count_of_output(), whole.size()) << name << ": a hidden file was left";
        std::filesystem::remove_all(folder / "out");
    }
}

}  // namespace voxelume
