// SPDX-License-Identifier: Apache-2.0
// Warnings about an object's voxels, and about solids of which nothing is left.
#include "runtime/analysis/warnings/object_warnings.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/analysis/warned_scene.hpp"
#include "tests/support/writers/array_writer.hpp"

namespace voxelume {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Kind = WarningKind;
using ObjectWarnings = WarnedScene;

}  // namespace

TEST_F(ObjectWarnings, NameModelsFinerAndCoarserThanTheWorldByMoreThanFour) {
    json["models"]["ball"]["surface"] = "cubes";
    json["models"]["ball"]["voxel_size"] = 0.0125;
    EXPECT_THAT(kinds(), IsEmpty());
    json["models"]["ball"]["voxel_size"] = 0.012;
    EXPECT_THAT(kinds(), ElementsAre(Kind::finer_than_world));
    EXPECT_THAT(warnings()[0].text,
                HasSubstr("give the model a \"voxel_size\" of 0.05, or the object \"placement\""));
    json["objects"][0]["placement"] = "instance";
    EXPECT_THAT(kinds(), IsEmpty());
    json["objects"][0].erase("placement");
    json["models"]["ball"]["surface"] = "smooth";  // its voxels are the world's
    EXPECT_THAT(kinds(), IsEmpty());
    show_mesh("ball.obj", ball({0, 0, 0}, 0.3, 32, 16));
    json["models"]["ball"]["resolution"] = 500;
    EXPECT_THAT(kinds(), IsEmpty());
    json["models"]["ball"] = {{"shape", "sphere"}, {"radius", 0.3}, {"surface", "smooth"}};
    json["models"]["ball"]["voxel_size"] = 0.2;
    EXPECT_THAT(kinds(), IsEmpty());
    json["models"]["ball"]["voxel_size"] = 0.21;
    EXPECT_THAT(kinds(), ElementsAre(Kind::coarser_than_world));
    json["models"]["ball"]["surface"] = "cubes";  // voxel art
    EXPECT_THAT(kinds(), IsEmpty());
}

TEST_F(ObjectWarnings, NameTheSizeThatAModelIsFittedTo) {
    show_mesh("part.obj", ball({0, 0, 0}, 0.3, 32, 16));
    json["models"]["ball"]["fit"] = 0.001;
    ASSERT_THAT(kinds(), Contains(Kind::unlikely_unit));
    EXPECT_THAT(warnings()[0].text,
                HasSubstr("so its size is probably wrong: its model's \"fit\" is 0.001 m"));
}

TEST_F(ObjectWarnings, NameNoVoxelsThatWouldBeFineEnoughForASheet) {
    Mesh sheet;
    sheet.positions = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    show_mesh("sheet.obj", sheet);
    json["models"]["ball"]["surface"] = "smooth";
    const std::vector<Warning> found = warnings();
    const auto thin = std::ranges::find(found, Kind::thinner_than_voxel, &Warning::kind);
    ASSERT_NE(thin, found.end());
    EXPECT_THAT(thin->text, HasSubstr("is flat, and its voxels are 0.05 m"));
    EXPECT_THAT(thin->text, Not(HasSubstr("voxels below")));
}

TEST_F(ObjectWarnings, NameExactMeshesOfManyTrianglesInAVoxelThatStayInTheWorld) {
    show_mesh("ball.obj", ball({0, 0, 0}, 0.1, 320, 160));
    json["models"]["ball"]["surface"] = "exact";
    json["objects"][0]["placement"] = "instance";
    EXPECT_THAT(kinds(), IsEmpty());
    json["objects"][0]["placement"] = "world";
    ASSERT_THAT(kinds(), ElementsAre(Kind::finer_than_world));
    EXPECT_THAT(warnings()[0].text, HasSubstr("a ray there tests all of them"));
    json["objects"][0]["scale"] = 8;
    EXPECT_THAT(kinds(), IsEmpty());
}

/// In the world, voxels of a size that the scene doesn't say are the world's, whatever the scale.
TEST_F(ObjectWarnings, SayNothingOfObjectsThatAreLargerThanTheirModels) {
    json["models"]["ball"] = {{"shape", "sphere"}, {"radius", 0.03}, {"surface", "smooth"}};
    json["objects"][0]["scale"] = 10;
    EXPECT_THAT(kinds(), IsEmpty());
    json["objects"][0]["placement"] = "instance";
    EXPECT_THAT(kinds(), IsEmpty());
    json["models"]["ball"]["voxel_size"] = 0.021;
    EXPECT_THAT(kinds(), ElementsAre(Kind::coarser_than_world)) << "as an instance, too";
}

/// Voxels of a file are as large as it says, and "voxel_size" is no key of such models.
TEST_F(ObjectWarnings, NameNoVoxelSizeForAFileOfVoxels) {
    put_bytes(folder / "cells.npy", npy_bytes("|u1", "4, 3, 2", std::string(24, '\1')));
    json["models"]["ball"] = {{"voxels", "cells.npy"}};
    json["objects"][0]["scale"] = 0.01;
    const std::vector<Warning> found = warnings();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, Kind::finer_than_world);
    EXPECT_THAT(found[0].text, HasSubstr("give the object \"placement\": \"instance\", or make it "
                                         "larger by its \"scale\" or the model's \"fit\""));
    EXPECT_THAT(found[0].text, Not(HasSubstr("voxel_size")));
    json["objects"][0]["placement"] = "instance";
    EXPECT_THAT(kinds(), IsEmpty());
}

TEST_F(ObjectWarnings, TellAnEmptySolidFromOneOutsideTheWorld) {
    const Json ball = {{"shape", "sphere"}, {"radius", 0.3}};
    Json other = ball;
    other["position"] = {0.5, 0.2, 0};
    json["models"]["ball"] = {{"shape", "intersection"}, {"parts", {ball, other}}};
    EXPECT_THAT(kinds(), IsEmpty()) << "they meet";
    other["position"] = {0.7, 0.2, 0};
    json["models"]["ball"]["parts"] = {ball, other};
    const std::vector<Warning> found = warnings();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, Kind::no_voxels);
    EXPECT_THAT(found[0].text, HasSubstr("\"ball\" is empty, so nothing shows it: the parts of its "
                                         "solid don't meet"));
    json["objects"][0]["position"] = {0, 5, 0};
    EXPECT_THAT(kinds(), ElementsAre(Kind::no_voxels)) << "wherever it is";
}

}  // namespace voxelume
