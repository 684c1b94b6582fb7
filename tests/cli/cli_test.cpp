// SPDX-License-Identifier: Apache-2.0
// The program's general behaviour, and the commands info and diff.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "runtime/base/files/stamp.hpp"
#include "runtime/image/flip.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/voxels/model_file.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/setting.hpp"

namespace voxelume {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

namespace {

Image grey_row(float first) {
    const std::vector<float> plane = {first, 0.5f, 1.0f};
    return {3,
            1,
            {{"R", plane}, {"G", plane}, {"B", plane}},
            {{"objectId", {0, 2, 9}}},
            {{"scene", "room.json"}}};
}

}  // namespace

class CliTest : public ProgramTest {};

TEST_F(CliTest, HelpListsCommandsAndExitCodesOnStdout) {
    for (const char* arguments : {"help", "--help", "-h"}) {
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0);
        EXPECT_THAT(result.out, HasSubstr("\n  diff "));
        EXPECT_THAT(result.out, HasSubstr("5  output that can't be written"));
        EXPECT_THAT(result.err, IsEmpty());
    }
}

TEST_F(CliTest, ACommandsHelpNamesItsOptions) {
    for (const char* arguments : {"help diff", "diff --help"})
        EXPECT_THAT(run(arguments).out, HasSubstr("--fail"));
}

TEST_F(CliTest, VersionIsFollowedByTheFactsOfTheBuild) {
    EXPECT_THAT(run("--version").out,
                testing::MatchesRegex("voxelume [0-9]+\\.[0-9]+\\.[0-9]+\ncommit: [^\n]+\n"
                                      "built by: [^\n]+\nwith: OpenEXR [^\n]+\n"));
}

TEST_F(CliTest, AMistypedCommandSuggestsTheNearest) {
    const ProgramResult result = run("inof a.exr");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err, "voxelume: no command named \"inof\"; did you mean \"info\"?\n");
    EXPECT_THAT(result.out, IsEmpty());
}

TEST_F(CliTest, UsageErrorsExitWithTwo) {
    for (const char* arguments : {"", "info", "info a b", "info --jsn a", "--json info a", "diff a",
                                  "diff a b --fail much", "help nothing"}) {
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 2) << arguments;
        EXPECT_THAT(result.err, StartsWith("voxelume: ")) << arguments;
    }
    EXPECT_THAT(run("info --jsn a").err, HasSubstr("did you mean \"--json\"?"));
}

TEST_F(CliTest, AFlagWithAValueIsAUsageError) {
    for (const char* flag : {"--ground=x", "--no-ground=5", "--ground --ground=1e30"}) {
        const ProgramResult result = run(std::string("render scene.json -o a.exr ") + flag);
        EXPECT_EQ(result.exit_code, 2) << flag;
        EXPECT_THAT(result.err, HasSubstr("--ground: it takes no value")) << flag;
    }
}

TEST_F(CliTest, AFullStdoutIsAnOutputError) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    const std::string line = "'" VXL_BINARY "' help >/dev/full 2>/dev/null";
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 5);
}

TEST_F(CliTest, InfoDescribesAnExr) {
    write_exr(folder / "a.exr", grey_row(0.25f));
    const ProgramResult result = run("info a.exr --json");
    EXPECT_EQ(result.exit_code, 0);
    const auto report = nlohmann::json::parse(result.out);
    EXPECT_EQ(report["kind"], "OpenEXR image");
    EXPECT_EQ(report["size"], nlohmann::json({3, 1}));
    EXPECT_EQ(report["attributes"]["scene"], "room.json");
    EXPECT_EQ(report["channels"][0]["channel"], "B");
    EXPECT_EQ(report["channels"][0]["type"], "half");
    EXPECT_EQ(report["channels"][0]["min"], 0.25);
    EXPECT_EQ(report["channels"][3]["max"], 9);
    EXPECT_THAT(run("info a.exr").out, HasSubstr("compression     ZIP\n"));
}

TEST_F(CliTest, InfoVerifiesFilesByTheChecksumsInThem) {
    Image image = grey_row(0.25f);
    write_png(folder / "without.png", image);
    EXPECT_THAT(run("info without.png --verify").err, HasSubstr("without.png: has no checksum"));
    image.attributes["frame"] = stamp_of("0123456789abcdef0123456789abcdef");
    write_exr(folder / "a.exr", image);
    ModelFile model;
    model.arrays["masks"] = std::vector<uint64_t>{1, 2, 3};
    write_model_file(folder / "a.vxm", model);
    for (const std::string name : {"a.exr", "a.vxm"}) {
        const ProgramResult whole = run("info " + name + " --verify");
        EXPECT_EQ(whole.exit_code, 0) << whole.err;
        EXPECT_THAT(whole.out, HasSubstr("kind"));
        std::string bytes = bytes_of(folder / name);
        bytes[bytes.size() - 20] ^= 4;
        put_bytes(folder / name, bytes);
        const ProgramResult damaged = run("info " + name + " --verify");
        EXPECT_EQ(damaged.exit_code, 4);
        EXPECT_THAT(damaged.err, HasSubstr(name + ": is damaged"));
        EXPECT_EQ(damaged.out, "");
    }
    EXPECT_EQ(run("info none.exr --verify").exit_code, 4);
}

TEST_F(CliTest, InfoDescribesPngModelVolumeAndMesh) {
    write_png(folder / "a.png", grey_row(0.25f));
    EXPECT_THAT(run("info a.png").out, HasSubstr("size            3 1\n"));
    ModelFile model;
    model.header["format"] = "cubes 1";
    model.arrays["masks"] = std::vector<uint64_t>{1, 2, 3};
    write_model_file(folder / "a.vxm", model);
    EXPECT_THAT(run("info a.vxm").out, testing::ContainsRegex("masks +u64 +3 +24"));
    const std::vector<glm::ivec3> cells = {{1, 2, 3}, {4, 5, 6}};
    const std::vector<float> values = {1.0f, 2.0f};
    VdbVolume volume;
    volume.cells = cells;
    volume.values = values;
    write_vdb(folder / "a.vdb", volume);
    EXPECT_THAT(run("info a.vdb").out,
                testing::ContainsRegex("density +float +fog volume +2 +1 2 3 +4 5 6"));
    put_bytes(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
    EXPECT_THAT(run("info a.obj").out, HasSubstr("triangles       1\n"));
}

TEST_F(CliTest, InfoOfWhatItCantReadExitsWithFour) {
    EXPECT_THAT(run("info a.exr").err, HasSubstr("a.exr: no such file"));
    EXPECT_EQ(run("info a.exr").exit_code, 4);
    put_bytes(folder / "a.exr", "\x76\x2f\x31\x01");
    EXPECT_EQ(run("info a.exr").exit_code, 4);
    put_bytes(folder / "notes.txt", "voxels");
    EXPECT_EQ(run("info notes.txt").exit_code, 4);
    EXPECT_EQ(run("info .").exit_code, 4);
}

TEST_F(CliTest, InfoDoesNotLetAFileSteerTheTerminal) {
    Image image = grey_row(0.0f);
    image.attributes["scene"] = "\x1b[2Jgone";
    write_exr(folder / "a.exr", image);
    EXPECT_THAT(run("info a.exr").out, Not(HasSubstr("\x1b")));
}

TEST_F(CliTest, StressSaysWhatItTriedAndHowOften) {
    const ProgramResult result = run("stress --rays 3e3 --seed 5 --only ties --only triangles");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out,
                testing::MatchesRegex("ties +3000 cases +0 mismatches +[0-9.]+ s\n"
                                      "triangles +37 cases +0 mismatches +[0-9.]+ s\n"));
    EXPECT_THAT(result.err, Not(HasSubstr("%")));  // no bar where nobody watches
    EXPECT_EQ(run("stress -q --rays 1 --first 40000 --only corners").err, "");
}

TEST_F(CliTest, StressPrintsALineThatFindsAMismatchAgain) {
    ProgramResult found;
    {
        const Setting fault("VOXELUME_BUILD_OPTIONS", "-DVXL_ARBITRATE=0  -DTELLS=\"it's\"");
        const Setting untested("VOXELUME_SELF_TEST", "off");  // which would refuse this device
        const Setting lanes("VOXELUME_LANES", "4"), work_group("VOXELUME_WORK_GROUP", "3");
        found = run("stress -q --rays 40 --seed 5 --first 16381 --only ties --device 'cpu'");
    }
    EXPECT_EQ(found.exit_code, 1) << found.err;
    const size_t line = found.out.find("  ties case "), end = found.out.find('\n', line);
    const std::string again = "    again: ";
    const size_t command = found.out.find(again, end), command_end = found.out.find('\n', command);
    ASSERT_NE(command_end, std::string::npos) << found.out;
    const std::string typed =
        found.out.substr(command + again.size(), command_end - command - again.size());
    EXPECT_THAT(typed, HasSubstr("VOXELUME_LANES=4 VOXELUME_WORK_GROUP=3 "));
    const ProgramResult result = run_line(typed);
    EXPECT_EQ(result.exit_code, 1) << typed << '\n' << result.err;
    EXPECT_THAT(result.err, HasSubstr(", 4 lanes, seed 5"));
    EXPECT_THAT(result.out, HasSubstr("1 cases          1 mismatches"));
    EXPECT_THAT(result.out, HasSubstr(found.out.substr(line, end - line)));
}

TEST_F(CliTest, StressTakesEachTestOnceHoweverItIsNamed) {
    const ProgramResult result = run("stress -q --rays 1 --only faces,ties --only ties");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, testing::MatchesRegex("faces .*\nties .*\n"));
    EXPECT_THAT(run("stress --rays 1 --only ties,none").err, HasSubstr("no test named \"none\""));
    EXPECT_EQ(run("stress -q --rays 1 --only ties --first 1000000000000000000").exit_code, 0);
    EXPECT_EQ(run("stress --rays 1 --first 1e18").exit_code, 2);
    EXPECT_THAT(run("stress --rays 1 --first 1e18").err,
                HasSubstr("a whole number from 0 to 1000000000000000000 in digits"));
    for (const char* none : {"-", "+", "-+", "''"}) {
        const ProgramResult refused = run(std::string("stress --rays 1 --first ") + none);
        EXPECT_EQ(refused.exit_code, 2) << none;
        EXPECT_THAT(refused.err, HasSubstr("isn't a whole number from 0")) << none;
    }
}

TEST_F(CliTest, StressKnowsItsTests) {
    const ProgramResult result = run("stress --only tie");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err,
              "voxelume: stress: there is no test named \"tie\"; did you mean \"ties\"?\n");
    for (const char* none : {"stress --only ,", "stress --only quux"}) {
        EXPECT_EQ(run(none).exit_code, 2);
        EXPECT_THAT(run(none).err, HasSubstr("random, ties, grazing, "));
    }
    EXPECT_THAT(run("bench --only ,").err, HasSubstr("\",\" names no scene; there are sphere, "));
    EXPECT_THAT(run("help stress").out, HasSubstr("rays between lattice points"));
    EXPECT_EQ(run("stress --rays 0").exit_code, 2);
}

TEST_F(CliTest, DiffMeasuresEachChannel) {
    write_exr(folder / "a.exr", grey_row(0.75f), ColorDepth::float32);
    write_exr(folder / "b.exr", grey_row(0.0f), ColorDepth::float32);
    const ProgramResult result = run("diff a.exr --json --channels R,objectId b.exr");
    EXPECT_EQ(result.exit_code, 0);
    const auto report = nlohmann::json::parse(result.out);
    ASSERT_EQ(report["channels"].size(), 2u);
    EXPECT_EQ(report["channels"][0]["max"], 0.75);
    EXPECT_NEAR(report["channels"][0]["rmse"], 0.4330127018922193, 1e-15);
    EXPECT_EQ(report["channels"][0]["mae"], 0.25);
    EXPECT_EQ(report["channels"][0]["differing"], 1);
    EXPECT_EQ(report["channels"][1]["differing"], 0);
    EXPECT_FALSE(report.contains("FLIP"));
}

TEST_F(CliTest, DiffSaysWhatEyesSee) {
    const Image light{64,
                      48,
                      {{"R", std::vector<float>(64 * 48, 0.5f)},
                       {"G", std::vector<float>(64 * 48, 0.25f)},
                       {"B", std::vector<float>(64 * 48, 0.125f)}},
                      {},
                      {}};
    Image other = light;
    std::ranges::fill(other.planes["G"], 0.5f);
    write_exr(folder / "a.exr", light, ColorDepth::float32);
    write_exr(folder / "b.exr", other, ColorDepth::float32);
    write_png(folder / "a.png", light);
    write_png(folder / "b.png", other);
    const auto flip = [&](const std::string& files) {
        return nlohmann::json::parse(run("diff --json " + files).out).at("FLIP").get<double>();
    };
    EXPECT_DOUBLE_EQ(flip("a.exr b.exr"), mean_flip(light, other));
    EXPECT_GT(flip("a.exr b.exr"), 0.1);
    EXPECT_NEAR(flip("a.png b.png"), flip("a.exr b.exr"), 0.005);  // codes are rounded
    EXPECT_EQ(flip("a.png a.png"), 0);
    EXPECT_THAT(run("diff a.exr b.exr").out, HasSubstr("FLIP"));
}

TEST_F(CliTest, DiffFailsOnlyAboveTheLimit) {
    write_exr(folder / "a.exr", grey_row(0.75f), ColorDepth::float32);
    write_exr(folder / "b.exr", grey_row(0.0f), ColorDepth::float32);
    EXPECT_EQ(run("diff a.exr b.exr --fail 0.44").exit_code, 0);
    const ProgramResult above = run("diff --fail 0.43 a.exr b.exr");
    EXPECT_EQ(above.exit_code, 1);
    EXPECT_THAT(above.err, HasSubstr("the RMSE of B is 0.433013, above 0.43"));
    EXPECT_EQ(run("diff a.exr a.exr --fail 0").exit_code, 0);
}

TEST_F(CliTest, DiffComparesPictures) {
    write_png(folder / "a.png", grey_row(1.0f));
    write_png(folder / "b.png", grey_row(0.0f));
    EXPECT_EQ(run("diff a.png a.png --fail 0").exit_code, 0);
    EXPECT_EQ(run("diff a.png b.png --fail 0.5").exit_code, 1);
}

TEST_F(CliTest, DiffRefusesWhatCantBeCompared) {
    write_exr(folder / "a.exr", grey_row(0.0f));
    write_png(folder / "a.png", grey_row(0.0f));
    write_exr(folder / "wide.exr", Image{2, 1, {{"R", {1, 2}}}, {}, {}});
    write_exr(folder / "red.exr", Image{3, 1, {{"R", {0, 0.5f, 1}}}, {}, {}});
    EXPECT_EQ(run("diff a.exr a.png").exit_code, 2);
    EXPECT_EQ(run("diff a.exr wide.exr").exit_code, 1);
    EXPECT_EQ(run("diff a.exr missing.exr").exit_code, 4);
    EXPECT_EQ(run("diff a.exr red.exr").exit_code, 0);
    EXPECT_THAT(run("diff a.exr red.exr --fail 0").err, HasSubstr("only A has channel B"));
    EXPECT_EQ(run("diff a.exr red.exr --fail 0 --channels R").exit_code, 0);
    EXPECT_THAT(run("diff a.exr a.exr --channels objectid").err,
                HasSubstr("no channel named \"objectid\"; did you mean \"objectId\"?"));
}

}  // namespace voxelume
