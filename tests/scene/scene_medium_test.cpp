// SPDX-License-Identifier: Apache-2.0
// The medium of a scene: the meaning of its keys, and the errors of wrong ones.
#include <gmock/gmock.h>

#include "runtime/scene/scene.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {

using testing::HasSubstr;

class SceneMedium : public FileTest {
  protected:
    Medium medium_of(const std::string& density) {
        return parse_scene(R"({"voxelume": 1, "world": {"voxel_size": 0.1,
"bounds": {"min": [0, 0, 0], "max": [1, 2, 3]},
"medium": {"absorption": [1, 2, 3], "density": )" +
                               density + R"(}},
"observer": {"position": [0, 0, 0], "display": {"shape": "ball", "radius": 2}}})",
                           folder / "fog.json", {})
            .world.medium;
    }
    std::string objection(const std::string& density) {
        return error_of([&] { medium_of(density); }).what();
    }
};

TEST_F(SceneMedium, DensitiesHaveTheNumbersOfTheirKeys) {
    const auto height = std::get<HeightDensity>(
        medium_of(R"({"kind": "height", "base": -1.5, "scale_height": 2})").density);
    EXPECT_EQ(height.base, -1.5);
    EXPECT_EQ(height.scale_height, 2);
    const auto ball = std::get<BallDensity>(
        medium_of(R"({"kind": "ball", "center": [1, 2, 3], "radius": 5, "falloff": 4})").density);
    EXPECT_EQ(ball.center, glm::dvec3(1, 2, 3));
    EXPECT_EQ(ball.radius, 5);
    EXPECT_EQ(ball.falloff, 4);
    put_bytes(folder / "smoke.vdb", "");
    const auto grid = std::get<GridDensity>(
        medium_of(R"({"kind": "grid", "file": "smoke.vdb", "position": [7, 5, 3]})").density);
    EXPECT_EQ(grid.file, std::filesystem::canonical(folder / "smoke.vdb"));
    EXPECT_EQ(grid.grid, "density");
    EXPECT_EQ(grid.world_from_grid[3], glm::dvec4(7, 5, 3, 1));
}

TEST_F(SceneMedium, WithoutADensityItIsAlikeEverywhere) {
    EXPECT_FALSE(has_density(Medium{}));
    EXPECT_TRUE(has_density(medium_of(R"({"kind": "height", "base": 0, "scale_height": 1})")));
}

TEST_F(SceneMedium, WrongDensitiesAreRefusedInTheirPlace) {
    EXPECT_THAT(objection(R"({"base": 1})"),
                HasSubstr("fog.json:3:48: world.medium.density: needs a \"kind\""));
    EXPECT_THAT(objection(R"({"kind": "hieght", "base": 1})"), HasSubstr("\"height\"?"));
    EXPECT_THAT(objection(R"({"kind": "height", "base": 0, "scale_height": 0})"),
                HasSubstr("must be above 0"));
    EXPECT_THAT(objection(R"({"kind": "ball", "center": [0, 0, 0], "radius": 1, "falloff": 1.5})"),
                HasSubstr("density.falloff: must not be larger than the radius, 1"));
    EXPECT_THAT(objection(R"({"kind": "grid", "file": "smoke.vdb", "radius": 1})"),
                HasSubstr("unknown key \"radius\""));
}

TEST_F(SceneMedium, AMissingFileIsAnInputErrorInItsPlace) {
    const Error error = error_of([&] { medium_of(R"({"kind": "grid", "file": "smoke.vdb"})"); });
    EXPECT_EQ(error.exit_code(), 4);
    EXPECT_THAT(error.what(), HasSubstr("density.file: there is no file \"smoke.vdb\""));
}

}  // namespace voxelume
