// SPDX-License-Identifier: Apache-2.0
// The self-test of every kernel.
#include <gmock/gmock.h>

#include <map>
#include <regex>
#include <set>

#include "runtime/opencl/source/kernel_source.hpp"
#include "tests/cli/scene_program.hpp"
#include "tests/support/setting.hpp"

namespace voxelume {
namespace {

using testing::IsEmpty;
using testing::MatchesRegex;

/// The files of all kernels by their names. No two kernels may have one name.
std::map<std::string, std::string> files_of_kernels() {
    std::map<std::string, std::string> files;
    const std::regex kernel("kernel\\s+void\\s+(\\w+)");
    for (const auto& [file, view] : embedded_kernels()) {
        const std::string text(view);
        for (std::sregex_iterator i(text.begin(), text.end(), kernel); i != std::sregex_iterator();
             ++i)
            EXPECT_TRUE(files.emplace((*i)[1], file).second) << (*i)[1];
    }
    return files;
}

class CliDoctorTest : public SceneProgramTest {};

TEST_F(CliDoctorTest, LaunchesEveryKernelComparesItsPicturesAndLeavesNoFiles) {
    const std::filesystem::path temporary = folder / "tmp";
    std::filesystem::create_directory(temporary);
    const Setting setting("TMPDIR", temporary.string());
    const ProgramResult result = run("doctor --json");
    ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
    EXPECT_TRUE(std::filesystem::is_empty(temporary));
    const Json report = Json::parse(result.out);
    std::map<std::string, std::string> files;
    for (const Json& row : report["kernels"]) {
        const std::string name = row["kernel"];
        files[name] = row["file"];
        EXPECT_EQ(row["state"], "right") << name;
        EXPECT_THAT(row["tests"], testing::Not(IsEmpty())) << name;
        // Kernels that only walk rays, or answer questions, have no hash: they are compared with
        // exact answers.
        const bool has_hash = row["file"] != "stress.cl" && row["file"] != "self_test.cl";
        EXPECT_EQ(row["hash"].is_string(), has_hash) << name;
    }
    EXPECT_EQ(files, files_of_kernels());
    for (const Json& row : report["pictures"])
        EXPECT_EQ(row["state"], "as known") << row["picture"] << row["hash"];
    for (const Json& row : report["tests"]) EXPECT_EQ(row["mismatches"], 0) << row["self-test"];
}

}  // namespace
}  // namespace voxelume
