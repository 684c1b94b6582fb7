// SPDX-License-Identifier: Apache-2.0
// Warnings about common mistakes in scenes; right scenes get none.
#include "runtime/analysis/warnings/scene_warnings.hpp"

#include <gmock/gmock.h>

#include <numeric>

#include "tests/analysis/warned_scene.hpp"
#include "tests/pictures/small_scene.hpp"

namespace voxelume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Kind = WarningKind;
using SceneWarnings = WarnedScene;

}  // namespace

TEST_F(SceneWarnings, SayNothingOfARightScene) {
    EXPECT_THAT(kinds(), IsEmpty());
    show_mesh("ball.obj", ball({0, 0, 0}, 0.3, 32, 16));
    EXPECT_THAT(kinds(), IsEmpty());
}

TEST_F(SceneWarnings, NameAnObjectOutsideTheWorldAndWhereItIs) {
    json["objects"][0]["position"] = {0.1, 4, 0};
    const std::vector<Warning> found = warnings();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, Kind::outside_world);
    EXPECT_THAT(found[0].where.text(), HasSubstr("room.json:"));
    EXPECT_THAT(found[0].where.text(), HasSubstr("objects[0]"));
    EXPECT_EQ(found[0].text,
              "\"ball\" lies outside the world, from (-0.2, 3.7, -0.3) to (0.4, 4.3, 0.3) m, so "
              "nothing shows it: the world reaches from (-1, -1, -1) to (1, 1, 1); move the "
              "object, or enlarge \"bounds\"");
    json["objects"][0]["position"] = {0.1, 1.2, 0};  // partly inside
    EXPECT_THAT(kinds(), IsEmpty());
    json["objects"][0]["position"] = {0.1, 4, 0};
    json["objects"][0]["visible"] = false;
    EXPECT_THAT(kinds(), IsEmpty());
}

TEST_F(SceneWarnings, NameASlabOutsideTheWorld) {
    json["objects"][1]["position"] = {0, -1.5, 0};
    EXPECT_THAT(kinds(), ElementsAre(Kind::outside_world));
}

TEST_F(SceneWarnings, NameWhatIsThinnerThanItsVoxels) {
    json["models"]["ball"] = {{"shape", "box"}, {"size", {0.5, 0.5, 0.02}}, {"surface", "smooth"}};
    EXPECT_THAT(kinds(), ElementsAre(Kind::thinner_than_voxel));
    EXPECT_THAT(warnings()[0].text, HasSubstr("is 0.02 m thin where it is thinnest, and its "
                                              "voxels are 0.05 m"));
    json["models"]["ball"]["surface"] = "exact";
    EXPECT_THAT(kinds(), IsEmpty());
    json["models"]["ball"]["surface"] = "cubes";  // a layer of voxels
    EXPECT_THAT(kinds(), IsEmpty());
    json["models"]["ball"]["set"] = "solid";
    EXPECT_THAT(kinds(), ElementsAre(Kind::thinner_than_voxel));
}

/// Unions of intersections of unions, ... of two balls.
Json alternating(int levels, double x) {
    if (levels == 0) return {{"shape", "sphere"}, {"radius", 0.3}, {"position", {x, 0, 0}}};
    const char* shape = levels % 2 == 0 ? "union" : "intersection";
    const double step = 0.1 / levels;
    return {{"shape", shape},
            {"parts", {alternating(levels - 1, x), alternating(levels - 1, x + step)}}};
}

TEST_F(SceneWarnings, NameSolidsThatAreTooDeepForSharpEdges) {
    json["models"]["ball"] = alternating(5, 0);
    json["models"]["ball"]["surface"] = "smooth";
    EXPECT_THAT(kinds(), ElementsAre(Kind::rounded_edges));
    EXPECT_THAT(warnings()[0].text, HasSubstr("edges within 1 of its combinations of solids"));
    json["models"]["ball"]["surface"] = "exact";
    EXPECT_THAT(kinds(), IsEmpty());
    json["models"]["ball"] = alternating(4, 0);
    json["models"]["ball"]["surface"] = "smooth";
    EXPECT_THAT(kinds(), IsEmpty());
    std::ofstream(folder / "block.obj")
        << "v 0 0 0\nv .9 0 0\nv 0 .9 0\nv 0 0 .9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    for (const int levels : {3, 5}) {
        json["models"]["ball"] = {{"mesh", "block.obj"},
                                  {"surface", "smooth"},
                                  {"voxel_size", 0.1},
                                  {"cut", {alternating(levels, 0)}}};
        EXPECT_EQ(std::ranges::count(kinds(), Kind::rounded_edges), levels == 5 ? 1 : 0) << levels;
    }
}

TEST_F(SceneWarnings, MeasureThicknessWhereTheObjectStands) {
    json["models"]["ball"] = {
        {"shape", "box"}, {"size", {0.5, 0.5, 0.06}}, {"surface", "smooth"}, {"voxel_size", 0.02}};
    json["objects"][0]["turn"] = {30, 20, 10};
    EXPECT_THAT(kinds(), IsEmpty());
    json["objects"][0]["scale"] = {1, 1, 0.5};
    EXPECT_THAT(kinds(), ElementsAre(Kind::thinner_than_voxel));
}

TEST_F(SceneWarnings, NameALightInTheFloorButNotOneInGlass) {
    json["lights"][0]["position"] = {0.5, -0.9, 0.6};
    EXPECT_THAT(kinds(), ElementsAre(Kind::light_inside_object));
    EXPECT_THAT(warnings()[0].text, HasSubstr("inside \"floor\", which is opaque"));
    json["objects"][1]["material"] = "glass";
    EXPECT_THAT(kinds(), IsEmpty());
    json["objects"][1].erase("material");
    json["render"]["shadows"] = false;
    EXPECT_THAT(kinds(), IsEmpty());
}

TEST_F(SceneWarnings, NameALightInAMeshButNotOneInAnOpenShade) {
    show_mesh("ball.obj", ball({0, 0, 0}, 0.3, 32, 16));
    json["models"]["ball"]["surface"] = "exact";
    json["lights"][0]["position"] = {0.15, -0.45, 0.05};
    EXPECT_THAT(kinds(), ElementsAre(Kind::light_inside_object));
    show_mesh("ball.obj", open_ball(0.3));
    json["models"]["ball"]["surface"] = "exact";
    EXPECT_THAT(kinds(), IsEmpty());
    show_mesh("ball.obj", turned(ball({0, 0, 0}, 0.3, 32, 16)));
    json["models"]["ball"]["surface"] = "exact";
    EXPECT_THAT(kinds(), ElementsAre(Kind::light_inside_object));
}

TEST_F(SceneWarnings, NameAnObserverInAWallButNotInARoom) {
    json["observer"]["position"] = {0, -0.9, 0.7};
    EXPECT_THAT(kinds(), ElementsAre(Kind::observer_in_object));
    json["observer"]["display"]["near"] = 0.5;
    json["observer"]["look_at"] = {0.3, 1, 0.7};  // the image begins outside of it
    EXPECT_THAT(kinds(), IsEmpty());
    // A room is a body with the observer and a light in it, or with objects.
    json["models"]["room"] = {{"shape", "box"}, {"size", {1.9, 1.9, 1.9}}, {"surface", "exact"}};
    json["objects"].push_back({{"model", "room"}});
    json["observer"] = {
        {"position", {0, 0, 0.8}}, {"look_at", {0, 0, 0}}, {"display", {{"shape", "pyramid"}}}};
    EXPECT_THAT(kinds(), IsEmpty());
    json["lights"][0]["position"] = {0, 5, 0};
    EXPECT_THAT(kinds(), IsEmpty());
}

TEST_F(SceneWarnings, NameAnObserverInABallInWhichAnotherIsStuck) {
    json["models"]["large"] = {{"shape", "sphere"}, {"radius", 0.5}};
    json["objects"].push_back({{"name", "large"}, {"model", "large"}, {"position", {0.3, 0, 0}}});
    json["objects"][0]["position"] = {0.3, 0.4, 0};  // its middle is inside, and it looks out
    json["lights"][0]["position"] = {0, 5, 0};
    json["observer"] = {
        {"position", {0.3, -0.3, 0}}, {"look_at", {0, 0, 0}}, {"display", {{"shape", "pyramid"}}}};
    EXPECT_THAT(kinds(), ElementsAre(Kind::observer_in_object));
    EXPECT_THAT(warnings()[0].text, HasSubstr("inside \"large\""));
}

TEST_F(SceneWarnings, LetAnObserverOfALatticeStandAnywhere) {
    json["observer"]["position"] = {0.2, -0.9, 0.1};
    json["observer"]["display"] = {{"shape", "ball"}, {"radius", 1}, {"layout", "lattice"}};
    EXPECT_THAT(kinds(), IsEmpty());
}

TEST_F(SceneWarnings, NameASceneWithoutAnyLight) {
    json["lights"] = Json::array();
    EXPECT_THAT(kinds(), ElementsAre(Kind::no_light));
    json["world"]["ambient"] = {0.1, 0.1, 0.1};
    EXPECT_THAT(kinds(), IsEmpty());
    json["world"].erase("ambient");
    json["materials"]["red"]["emission"] = {1, 1, 1};
    EXPECT_THAT(kinds(), IsEmpty());
    json["objects"][0]["visible"] = false;
    EXPECT_THAT(kinds(), ElementsAre(Kind::no_light)) << "a hidden emissive object";
}

TEST_F(SceneWarnings, TellWhatGlobalLightVolumesLeaveOut) {
    json["render"]["light"] = "global";
    json["world"]["medium"] = {{"scattering", {0.1, 0.1, 0.1}}};
    EXPECT_THAT(kinds(), IsEmpty());
    const auto of_volume = [&] {
        Scene scene = parse_scene(json.dump(), folder / "s.json", {});
        scene.render.shows_volume = true;
        AssetStore meshes;
        std::vector<Kind> found;
        for (const Warning& w : scene_warnings(scene, std::array{1}, meshes))
            found.push_back(w.kind);
        return found;
    };
    EXPECT_THAT(of_volume(), ElementsAre(Kind::ignored_scattering));
    json["render"]["light"] = "local";
    EXPECT_THAT(of_volume(), ElementsAre(Kind::ignored_scattering));
    json["world"].erase("medium");
    EXPECT_THAT(of_volume(), IsEmpty());
}

TEST_F(SceneWarnings, NameScatteringInLocalLightInAllFrames) {
    json["world"]["medium"] = {{"scattering", {0.1, 0.1, 0.1}}};
    json["animation"] = Json::parse(R"({"frames": 3, "tracks": [
        {"target": "objects.ball.position", "keys": [{"frame": 1, "value": [0.1, 0, 0]},
                                                     {"frame": 3, "value": [0.2, 0, 0]}]}]})");
    EXPECT_THAT(kinds({1, 2, 3}), ElementsAre(Kind::ignored_scattering));
    json["render"]["light"] = "global";
    EXPECT_THAT(kinds({1, 2, 3}), IsEmpty());
}

TEST_F(SceneWarnings, NameSettingsWithoutEffect) {
    const auto expect_one = [&](const char* key, const char* part) {
        ASSERT_THAT(kinds(), ElementsAre(Kind::no_effect)) << part;
        EXPECT_THAT(warnings()[0].where.key, HasSubstr(key));
        EXPECT_THAT(warnings()[0].text, HasSubstr(part));
    };
    const Json plain = json;
    json["observer"].update({{"aperture", 0.1}, {"focus", 2}});
    expect_one("observer", "sharp everywhere");
    json["render"]["samples"] = 4;
    EXPECT_THAT(kinds(), IsEmpty());
    json["observer"].update({{"aperture", 0}, {"blades", 6}});
    expect_one("observer", "there is none");
    json = plain;
    json["render"]["filter"] = "gaussian";
    expect_one("render.filter", "all filters are the same");
    json["render"]["samples"] = 4;
    EXPECT_THAT(kinds(), IsEmpty());
    json = plain;
    json["render"].update({{"adaptive", 0.1}, {"samples", 4}});
    EXPECT_THAT(kinds(), IsEmpty());
    json["render"]["light"] = "global";
    expect_one("render.adaptive", "use --noise");
}

TEST_F(SceneWarnings, OfFramesAreWhatHoldsInAllOfThem) {
    json["objects"][0]["position"] = {0.1, 4, 0};
    json["animation"] = Json::parse(R"({"frames": 10, "tracks": [
        {"target": "objects.ball.position", "keys": [{"frame": 1, "value": [0.1, 4, 0]},
                                                     {"frame": 10, "value": [0.1, 0, 0]}]}]})");
    EXPECT_THAT(kinds({1}), ElementsAre(Kind::outside_world));
    EXPECT_THAT(kinds({1, 2}), ElementsAre(Kind::outside_world));
    std::vector<int> all(10);
    std::iota(all.begin(), all.end(), 1);
    EXPECT_THAT(kinds(all), IsEmpty());
}

TEST_F(SceneWarnings, NameACacheThatCannotBeWritten) {
    put_bytes(folder / "file", "no folder");
    AssetStore meshes(ModelCache(folder / "file" / "models", 1 << 20));
    const std::vector<Warning> found =
        scene_warnings(parse_scene(json.dump(), folder / "room.json", {}), std::vector{1}, meshes);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, Kind::cache_not_writable);
    EXPECT_EQ(found[0].where.text(), (folder / "file" / "models").string());
    EXPECT_THAT(found[0].text, HasSubstr("Not a directory"));
}

TEST(SceneWarningsOfShippedScenes, AreNone) {
    const AssetFolders assets{"/usr/share/glmark2/models"};  // Debian's glmark2-data
    AssetStore meshes;
    size_t scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kScenes)) {
        const std::filesystem::path& file = entry.path();
        if (file.extension() != ".json" || file.stem().extension() == ".schema") continue;
        const Scene scene = read_scene(file, assets);
        std::vector<int> frames(size_t(scene.animation.frames));
        std::iota(frames.begin(), frames.end(), 1);
        for (const Warning& warning : scene_warnings(scene, frames, meshes))
            ADD_FAILURE() << warning.where.text() << ": " << warning.text;
        ++scenes;
    }
    EXPECT_GE(scenes, 15u);
}

}  // namespace voxelume
