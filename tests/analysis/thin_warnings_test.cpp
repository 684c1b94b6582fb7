// SPDX-License-Identifier: Apache-2.0
// Warnings about parts of meshes that are thinner than their voxels.
#include "runtime/analysis/warnings/thin_warnings.hpp"

#include "tests/analysis/warned_scene.hpp"
#include "tests/support/finned_ball.hpp"

namespace voxelume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Kind = WarningKind;
using ThinWarnings = WarnedScene;

}  // namespace

TEST_F(ThinWarnings, NameAThinPartOfAMesh) {
    Mesh fin = ball({0, 0, 0}, 0.3, 48, 24);
    const Mesh sheet = box({0.4f, 0, 0}, {0.48f, 0.08f, 0.01f});  // 1 % of the area
    const auto first = uint32_t(fin.positions.size());
    fin.positions.insert(fin.positions.end(), sheet.positions.begin(), sheet.positions.end());
    for (const glm::uvec3& t : sheet.triangles) fin.triangles.push_back(t + first);
    show_mesh("fin.obj", fin);
    json["models"]["ball"]["surface"] = "smooth";
    EXPECT_THAT(kinds(), ElementsAre(Kind::thinner_than_voxel));
    EXPECT_THAT(warnings()[0].text,
                HasSubstr("parts of \"fin.obj\" are less than 0.2 voxels thick"));
    json["objects"].push_back(json["objects"][0]);
    json["objects"].back().erase("name");
    json["objects"].back()["scale"] = 1.1;
    EXPECT_THAT(kinds(), ElementsAre(Kind::thinner_than_voxel));  // once of a mesh
    json["models"]["ball"]["surface"] = "exact";
    EXPECT_THAT(kinds(), IsEmpty());
}

TEST_F(ThinWarnings, NameThinWallsOfAMeshWithSharpEdges) {
    const auto show_cup = [&](double wall) {
        show_mesh("cup.obj", turned_outline({{0, -0.3},
                                             {0.3, -0.3},
                                             {0.3, 0.3},
                                             {0.3 - wall, 0.3},
                                             {0.3 - wall, wall - 0.3},
                                             {0, wall - 0.3}},
                                            48));
        json["models"]["ball"]["surface"] = "smooth";
    };
    show_cup(0.01);
    EXPECT_THAT(kinds(), ElementsAre(Kind::thinner_than_voxel));
    EXPECT_THAT(warnings()[0].text, HasSubstr("voxels thick and get lost on \"smooth\""));
    show_cup(0.15);
    EXPECT_THAT(kinds(), IsEmpty());
}

}  // namespace voxelume
