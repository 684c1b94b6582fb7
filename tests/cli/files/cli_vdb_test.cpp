// SPDX-License-Identifier: Apache-2.0
// OpenVDB files through every command: damaged ones are refused, long sequences don't hang.
#include <gmock/gmock.h>

#include <random>

#include "tests/cli/scene_program.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {

using testing::AnyOf;
using testing::HasSubstr;

class CliVdbTest : public SceneProgramTest {
  protected:
    void SetUp() override {
        SceneProgramTest::SetUp();
        put_bytes(folder / "a.obj", kTetrahedron);
        ASSERT_EQ(run("voxelize a.obj --resolution 12 --surface smooth -o a.vdb").exit_code, 0);
        bytes = bytes_of(folder / "a.vdb");
    }

    /// Writes the scene with a model and a density that come from a file, or a sequence of them.
    void write_vdb_scene(const std::string& file, const Json& sequence = nullptr) {
        write_scene([&](Json& scene) {
            scene["models"]["thing"] = {{"voxels", file}, {"surface", "smooth"}};
            Json density = {{"kind", "grid"}, {"file", file}, {"grid", "surface"}};
            if (!sequence.is_null()) {
                density["sequence"] = sequence;
                scene["models"]["thing"]["sequence"] = sequence;
            }
            scene["world"]["medium"] = {{"absorption", {1, 1, 1}}, {"density", density}};
        });
    }

    /// The file as another program might have written it, with another identifier.
    std::string foreign(int number) const {
        std::string copy = bytes;
        return copy.replace(21, 36, fmt::format("{:08x}-0000-4000-8000-000000000000", number));
    }

    std::string bytes;
};

TEST_F(CliVdbTest, ASequenceWithOverlappingFramesIsReadToItsEnd) {
    const int frames = is_exhaustive() ? 80 : 16;  // a bare fork hung after 46 to 72 of them
    for (int frame = 1; frame <= frames; ++frame)
        put_bytes(folder / fmt::format("s.{:03}.vdb", frame), foreign(frame));
    write_vdb_scene("s.###.vdb", {{"first", 1}, {"last", frames}});
    const ProgramResult result = run(fmt::format(
        "render scene.json --frames 1-{} --size 8x6 --no-cache -o o.###.png -q", frames));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(std::filesystem::exists(folder / fmt::format("o.{:03}.png", frames)));
}

TEST_F(CliVdbTest, ALevelSetIsViewedAsWhatItIs) {
    ASSERT_EQ(run("view a.vdb -o a.png --size 80x64").exit_code, 0);
    EXPECT_GT(bytes_of(folder / "a.png").size(), 200u);
}

TEST_F(CliVdbTest, DamagedFilesAreRefusedByEveryCommand) {
    write_vdb_scene("bad.vdb");
    const auto expect_refused = [&](int code, const std::string& arguments) {
        EXPECT_THAT(expect_failure(code, arguments), HasSubstr("bad.vdb")) << arguments;
    };
    for (const size_t size : {size_t{8}, size_t{60}, bytes.size() / 2, bytes.size() - 1}) {
        put_bytes(folder / "bad.vdb", bytes.substr(0, size));
        expect_refused(4, "info bad.vdb");
        expect_refused(4, "check scene.json");
        expect_refused(4, "render scene.json -o o.png");
        expect_refused(4, "convert bad.vdb o.nrrd");
        expect_refused(4, "view bad.vdb -o o.png");
        expect_refused(4, "diff bad.vdb bad.vdb");
        expect_refused(4, "voxelize bad.vdb -o o.vxm");
    }
}

TEST_F(CliVdbTest, ThreeWrongBytesNeverCrashACommand) {
    write_vdb_scene("bad.vdb");
    std::mt19937 random(3);
    for (int i = 0; i < (is_exhaustive() ? 15 : 5); ++i) {
        std::string changed = foreign(i);
        for (int change = 0; change < 3; ++change)
            changed[random() % bytes.size()] = char(random());
        put_bytes(folder / "bad.vdb", changed);
        for (const char* command : {"info bad.vdb", "check scene.json"})
            EXPECT_THAT(run(command).exit_code, AnyOf(0, 4, 8)) << i << ": " << command;
    }
}

}  // namespace voxelume
