// SPDX-License-Identifier: Apache-2.0
// A scene and an animation that are rendered in parts.
#pragma once

#include <gmock/gmock.h>

#include <map>

#include "tests/cli/scene_program.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {

class ShardProgramTest : public SceneProgramTest {
  protected:
    static constexpr const char* kImage =
        "render scene.json -q -o p.exr -o p.png --size 21x37 --samples 2 --exposure 0.5 "
        "--view-transform agx --png-bits 16 ";
    static constexpr const char* kFrames = "render moving.json -q -o f.##.exr -o f.##.png ";

    void SetUp() override {
        SceneProgramTest::SetUp();
        Json scene = Json::parse(kScene);
        scene["animation"] = Json::parse(R"({"frames": 5, "tracks": [{
            "target": "objects[0].turn", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                  {"frame": 5, "value": [9, 9, 9]}]}]})");
        put_bytes(folder / "moving.json", scene.dump(1));
    }

    /// The files of pictures, but for those of parts.
    std::map<std::string, std::string> pictures(char first) const {
        std::map<std::string, std::string> files;
        for (const std::string& name : names())
            if (name.front() == first && name.find(".shard") == name.npos)
                files[name] = bytes_of(folder / name);
        return files;
    }

    void remove(const std::map<std::string, std::string>& files) const {
        for (const auto& [name, bytes] : files) std::filesystem::remove(folder / name);
    }

    void remove_parts() const {
        for (const std::string& name : names())
            if (name.find(".shard") != name.npos) std::filesystem::remove(folder / name);
    }

    void render_parts(const std::string& line, int count) const {
        for (int number = count; number >= 1; --number) {
            const ProgramResult result = run(fmt::format("{} --shard {}/{}", line, number, count));
            ASSERT_EQ(result.exit_code, 0) << result.err;
        }
    }

    /// Expects that the parts of `line` merge to its files.
    void expect_merged(const std::string& line, char first, const std::string& parts) {
        ASSERT_EQ(run(line).exit_code, 0);
        const auto whole = pictures(first);
        ASSERT_GE(whole.size(), 2u);
        for (const int count : {1, 2, 3, 8}) {
            if (!is_exhaustive() && count != 1 && count != 3) continue;
            remove(whole);
            remove_parts();
            render_parts(line, count);
            const ProgramResult result = run("merge " + parts + "*");
            ASSERT_EQ(result.exit_code, 0) << result.err;
            EXPECT_EQ(pictures(first), whole) << count;
            EXPECT_THAT(result.err, testing::HasSubstr(fmt::format(" of {} parts\n", count)));
        }
    }

    std::string refusal(const std::string& parts) const {
        const ProgramResult result = run("merge " + parts);
        EXPECT_EQ(result.exit_code, 4) << parts;
        return result.err;
    }
};

}  // namespace voxelume
