// SPDX-License-Identifier: Apache-2.0
// Models from files: their sizes, and worlds that are fitted to them.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>

#include "runtime/base/error.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

/// Scenes whose files are as large as `boxes` says; `reads` counts the questions.
class FittedModel : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        for (const char* file : {"m.obj", "end.obj", "v.vxm", "s1.obj", "s2.obj", "s3.obj"})
            put_bytes(folder / file, "");
    }

    Scene parse(const std::string& model, const std::string& members = "") {
        reads.clear();
        const std::string text = fmt::format(
            R"({{"voxelume": 1, "world": {{"voxel_size": 0.25}}, "models": {{"m": {{{}}}}},
                 "objects": [{{"model": "m"}}]{}}})",
            model, members);
        return parse_scene(text, folder / "s.json", {}, [&](const Model& of, bool is_first) {
            const std::string name = (of.voxels.empty() ? of.mesh : of.voxels).filename();
            ++reads[name + (is_first ? "" : " later")];
            return boxes.at(name);
        });
    }

    std::string message(const std::string& model) {
        return error_of([&] { parse(model); }).what();
    }

    std::map<std::string, Bounds> boxes = {
        {"m.obj", {{10, 20, 30}, {14, 28, 36}}}, {"end.obj", {{0, 0, 0}, {4, 8, 6}}},
        {"v.vxm", {{-1, -2, -3}, {1, 2, 3}}},    {"s1.obj", {{0, 0, 0}, {1, 1, 1}}},
        {"s2.obj", {{0, 0, 0}, {2, 1, 1}}},      {"s3.obj", {{-3, 0, 0}, {1, 1, 1}}}};
    std::map<std::string, int> reads;
};

using Reads = std::map<std::string, int>;

}  // namespace

TEST_F(FittedModel, GivesTheWorldTheBoxOfItsFile) {
    const Scene scene = parse(R"("mesh": "m.obj")");
    EXPECT_EQ(scene.world.bounds, (Bounds{{9, 19, 29}, {15, 29, 37}}));
    EXPECT_EQ(reads, (Reads{{"m.obj", 1}}));
    EXPECT_EQ(parse(R"("voxels": "v.vxm")").world.bounds, (Bounds{{-2, -3, -4}, {2, 3, 4}}));
}

TEST_F(FittedModel, IsScaledToItsLongestSideAroundTheOrigin) {
    const Scene scene = parse(R"("mesh": "m.obj", "fit": 2)");
    EXPECT_EQ(scene.models[0].object_from_file, (FileMap{0.25, {-3, -6, -8.25}}));
    EXPECT_EQ(scene.world.bounds, (Bounds{{-1.5, -2, -1.75}, {1.5, 2, 1.75}}));
    EXPECT_EQ(parse(R"("voxels": "v.vxm", "fit": 3)").models[0].object_from_file,
              (FileMap{0.5, {0, 0, 0}}));
}

TEST_F(FittedModel, HasItsFilesUnit) {
    EXPECT_EQ(parse(R"("mesh": "m.obj", "unit": "in")").models[0].object_from_file,
              (FileMap{0.0254, {0, 0, 0}}));
    EXPECT_EQ(parse(R"("mesh": "m.obj", "unit": "dm")").world.bounds,
              (Bounds{{0, 1, 2}, {2.5, 4, 4.75}}));
    EXPECT_TRUE(parse(R"("mesh": "m.obj", "unit": "m")").models[0].object_from_file.is_identity());
}

TEST_F(FittedModel, RefusesSizesThatMeanNothing) {
    EXPECT_THAT(message(R"("mesh": "m.obj", "fit": 0)"), HasSubstr("m.fit: must be above 0"));
    EXPECT_THAT(message(R"("mesh": "m.obj", "fit": 1, "unit": "mm")"),
                HasSubstr("m.unit: \"fit\" decides the size, whatever the file's unit is; leave "
                          "one of them out"));
    EXPECT_THAT(message(R"("mesh": "m.obj", "unit": "inch")"),
                HasSubstr("m.unit: does not know \"inch\"; known are \"um\", \"mm\""));
    EXPECT_THAT(message(R"("shape": "sphere", "radius": 1, "fit": 1)"),
                HasSubstr("unknown key \"fit\""));
    boxes["m.obj"] = {{1, 2, 3}, {1, 2, 3}};
    EXPECT_THAT(message(R"("mesh": "m.obj", "fit": 1)"),
                HasSubstr("models.m: all of the file is one point, which can't be fitted"));
    const Error point = error_of([&] {
        parse_scene(R"({"voxelume": 1, "models": {"m": {"mesh": "m.obj", "surface": "smooth"}},
                        "objects": [{"model": "m"}]})",
                    folder / "s.json", {}, [&](const Model&, bool) { return boxes["m.obj"]; });
    });
    EXPECT_THAT(point.what(), HasSubstr("world: all objects are one point, which gives the world "
                                        "no voxel size; give it a \"voxel_size\""));
}

TEST_F(FittedModel, KeepsItsMapThroughASequence) {
    const std::string moving = R"(, "animation": {"frames": 5})";
    const Scene scene =
        parse(R"("mesh": "s#.obj", "sequence": {"first": 1, "last": 3}, "fit": 2)", moving);
    EXPECT_EQ(scene.models[0].object_from_file, (FileMap{2, {-1, -1, -1}}));
    EXPECT_EQ(scene.world.bounds, (Bounds{{-8, -2, -2}, {4, 2, 2}}));
    EXPECT_EQ(reads, (Reads{{"s1.obj", 2}, {"s2.obj later", 1}, {"s3.obj later", 1}}))
        << "twice for the fit and the world; the store reads a file once";
}

TEST_F(FittedModel, MorphsBetweenTwoBoxes) {
    const auto bounds_at = [&](const std::string& morph) {
        return parse(R"("mesh": "m.obj", "morph": {)" + morph + "}").world.bounds;
    };
    EXPECT_EQ(bounds_at(R"("mesh": "end.obj", "amount": 0.5)"), (Bounds{{4, 9, 14}, {10, 19, 22}}));
    EXPECT_EQ(bounds_at(R"("center": [0, 0, 0], "radius": 2, "amount": 1)"),
              (Bounds{{-3, -3, -3}, {3, 3, 3}}));
    EXPECT_EQ(reads, (Reads{{"m.obj", 1}}));
}

TEST_F(FittedModel, IsReadOnlyWhereSomethingIsFitted) {
    const Scene scene =
        parse_scene(R"({"voxelume": 1, "models": {"m": {"mesh": "m.obj", "surface": "smooth"}},
        "objects": [{"model": "m"}], "world": {"bounds": {"min": [0, 0, 0], "max": [1, 2, 3]}},
        "observer": {"position": [0, 0, 0], "display": {"shape": "ball", "radius": 2}}})",
                    folder / "s.json", {});
    EXPECT_TRUE(scene.models[0].object_from_file.is_identity());
}

TEST_F(FittedModel, IsBoxedAfterItsObjectsMap) {
    const Scene turned = parse_scene(
        R"({"voxelume": 1, "world": {"voxel_size": 0.25}, "models": {"m": {"voxels": "v.vxm"}},
            "objects": [{"model": "m", "turn": [90, 0, 0], "scale": 2, "position": [1, 0, 0]}]})",
        folder / "s.json", {}, [&](const Model&, bool) { return boxes["v.vxm"]; });
    EXPECT_EQ(turned.world.bounds, (Bounds{{-6, -5, -3}, {8, 5, 3}}));
}

}  // namespace voxelume
