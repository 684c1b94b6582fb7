// SPDX-License-Identifier: Apache-2.0
// How `diff` compares ids: they are equal or unequal, and unequal ones fail unless some are
// allowed.
#include <gmock/gmock.h>

#include "runtime/io/image/exr.hpp"
#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

class CliDiffIdsTest : public ProgramTest {
  protected:
    static constexpr int kIdsPixels = 1000;

    static Image grey() {
        const std::vector<float> plane(kIdsPixels, 0.25f);
        return {40, 25, {{"R", plane}, {"G", plane}, {"B", plane}}, {}, {}};
    }
};

TEST_F(CliDiffIdsTest, UnequalIdsFailUnlessSomeAreAllowed) {
    const auto put = [&](const char* name, int count) {
        Image image = grey();
        std::vector<uint32_t> ids(kIdsPixels, 3);
        for (int i = 0; i < count; ++i) ids[size_t(i)] = 5;
        image.id_planes["objectId"] = ids;
        write_exr(folder / name, image, ColorDepth::float32);
    };
    put("a.exr", 10);
    put("b.exr", 0);
    const auto code = [&](const std::string& options) {
        return run("diff a.exr b.exr " + options).exit_code;
    };
    const ProgramResult strict = run("diff a.exr b.exr --fail 1000");
    EXPECT_EQ(strict.exit_code, 1);
    EXPECT_THAT(strict.err, HasSubstr("10 pixels of objectId have unequal ids, and 0 may"));
    EXPECT_EQ(code(""), 0);
    EXPECT_EQ(code("--fail 0 --channels R,G,B"), 0);
    EXPECT_EQ(code("--fail 0 --fail-ids 10"), 0);
    EXPECT_EQ(code("--fail 0 --fail-ids 9"), 1);
    EXPECT_EQ(code("--fail-ids 1%"), 0);
    EXPECT_EQ(code("--fail-ids 0.9%"), 1);
    EXPECT_EQ(code("--fail-ids 9 --channels R"), 0);
    EXPECT_EQ(code("--fail-flip 0"), 0);
    EXPECT_EQ(code("--fail-ids -1"), 2);
    EXPECT_EQ(code("--fail-ids 101%"), 2);
    put("a1.exr", 10), put("b1.exr", 0);
    EXPECT_EQ(Json::parse(run("diff --json a#.exr b#.exr").out)["frames"][0]["worst"], "objectId");
}

TEST_F(CliDiffIdsTest, CryptomattesIdsFailAndItsCoverageIsLight) {
    const auto put = [&](const char* name, float id, float coverage) {
        Image image = grey();
        image.planes["CryptoObject00.R"] = std::vector<float>(kIdsPixels, id);
        image.planes["CryptoObject00.G"] = std::vector<float>(kIdsPixels, coverage);
        image.attributes["cryptomatte/1234567/name"] = "CryptoObject";
        write_exr(folder / name, image, ColorDepth::float32);
    };
    put("a.exr", 1e-20f, 1);
    put("b.exr", 2e-20f, 0.5f);
    EXPECT_THAT(run("diff a.exr b.exr --fail 0.6").err,
                HasSubstr("1000 pixels of CryptoObject00.R have unequal ids"));
    EXPECT_EQ(run("diff a.exr b.exr --fail 0.6 --fail-ids 100%").exit_code, 0);
    EXPECT_THAT(run("diff a.exr b.exr --fail 0.4 --fail-ids 100%").err,
                HasSubstr("the RMSE of CryptoObject00.G is 0.5"));
}

}  // namespace
}  // namespace voxelume
