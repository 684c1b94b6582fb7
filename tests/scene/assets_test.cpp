// SPDX-License-Identifier: Apache-2.0
// Files that scenes name: in which folders they are found, and in which never.
#include "runtime/scene_file/assets.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene_file/read_scene.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "runtime/scene/scene.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Two asset folders next to the scene's, and a secret file outside all of them.
class SceneAssets : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        for (const char* name : {"scene/sub", "first", "second"})
            fs::create_directories(folder / name);
        for (const char* file : {"scene/here.obj", "scene/sub/deep.obj", "first/a.obj",
                                 "second/a.obj", "second/b.obj", "secret.obj"}) {
            put_bytes(folder / file, "v 0 0 0\n");
        }
    }

    Scene parse_with_mesh(const std::string& mesh) {
        return parse_scene(R"({"voxelume": 1,
"world": {"voxel_size": 1, "bounds": {"min": [0, 0, 0], "max": [1, 2, 3]}},
"models": {"m": {"mesh": ")" + mesh +
                               R"("}},
"objects": [{"model": "m", "materials": {"lid": "default"}}],
"observer": {"position": [0, 0, 0], "display": {"shape": "pyramid"}}})",
                           folder / "scene" / "s.json", {folder / "first", folder / "second"});
    }
    void expect_found(const std::string& mesh, const std::string& file) {
        EXPECT_EQ(parse_with_mesh(mesh).models[0].mesh, fs::canonical(folder / file));
    }
    std::string refusal(const std::string& mesh, ErrorKind kind) {
        try {
            parse_with_mesh(mesh);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), kind) << error.what();
            return error.what();
        }
        return "no error";
    }
};

}  // namespace

TEST_F(SceneAssets, AreLookedForNextToTheSceneThenInEachFolder) {
    expect_found("here.obj", "scene/here.obj");
    expect_found("sub/deep.obj", "scene/sub/deep.obj");
    expect_found("a.obj", "first/a.obj");
    expect_found("b.obj", "second/b.obj");
}

TEST_F(SceneAssets, AMissingOneListsTheFoldersSearched) {
    const std::string said = refusal("c.obj", ErrorKind::input);
    EXPECT_THAT(said,
                HasSubstr("s.json:3:26: models.m.mesh: there is no file \"c.obj\"; searched "));
    for (const char* name : {"scene", "first", "second"})
        EXPECT_THAT(said, HasSubstr((folder / name).string()));
}

TEST_F(SceneAssets, NeverLieOutsideTheFolders) {
    EXPECT_THAT(refusal((folder / "secret.obj").string(), ErrorKind::scene),
                HasSubstr("is an absolute path"));
    EXPECT_THAT(refusal("../secret.obj", ErrorKind::scene), HasSubstr("leads out"));
    EXPECT_THAT(refusal("sub/../here.obj", ErrorKind::scene), HasSubstr("leads out"));
    fs::create_symlink("../secret.obj", folder / "scene" / "link.obj");
    EXPECT_THAT(refusal("link.obj", ErrorKind::scene), HasSubstr("is a link that leads out of"));
    fs::create_directory_symlink(folder, folder / "scene" / "up");
    EXPECT_THAT(refusal("up/secret.obj", ErrorKind::scene),
                HasSubstr("is a link that leads out of"));
    fs::create_symlink("here.obj", folder / "scene" / "inner.obj");
    expect_found("inner.obj", "scene/here.obj");
}

TEST_F(SceneAssets, AreFiles) {
    EXPECT_THAT(refusal("sub", ErrorKind::input), HasSubstr("is not a file"));
    fs::create_symlink("loop.obj", folder / "scene" / "loop.obj");
    EXPECT_THAT(refusal("loop.obj", ErrorKind::input), HasSubstr("can't be looked at"));
}

TEST_F(SceneAssets, FoldersOfTheEnvironmentComeLast) {
    ::setenv("VOXELUME_ASSETS", ":/one::/two words:", 1);
    EXPECT_EQ(asset_folders({"given"}), (AssetFolders{"given", "/one", "/two words"}));
    ::unsetenv("VOXELUME_ASSETS");
    EXPECT_EQ(asset_folders({}), AssetFolders{});
}

TEST_F(SceneAssets, GroupsOfFacesGetTheirMaterialsByName) {
    const Object object = parse_with_mesh("here.obj").objects[0];
    Object with_glass = object;
    with_glass.material = 4;
    with_glass.groups[0].material = 2;
    EXPECT_EQ(materials_of_groups(with_glass, {"side", "lid"}), (std::vector<int>{4, 2}));
    with_glass.groups.clear();
    EXPECT_EQ(materials_of_groups(with_glass, {}), (std::vector<int>{4}));
    try {
        materials_of_groups(object, {"side", "lids"});
        ADD_FAILURE() << "a group that the mesh does not have was accepted";
    } catch (const Error& error) {
        EXPECT_THAT(
            error.what(),
            HasSubstr("s.json:4:49: objects[0].materials.lid: the mesh has no group of faces "
                      "named \"lid\"; did you mean \"lids\"?"));
    }
}

TEST_F(SceneAssets, ASceneThatIsMissingOrTooLargeHasItsOwnKindOfError) {
    const auto kind_of_reading = [](const fs::path& file) {
        return error_of([&] { read_scene(file, {}); }).kind();
    };
    EXPECT_EQ(kind_of_reading(folder / "none.json"), ErrorKind::input);
    EXPECT_EQ(kind_of_reading(folder / "scene"), ErrorKind::input);
    std::ofstream(folder / "large.json") << "{";
    fs::resize_file(folder / "large.json", (64 << 20) + 1);
    EXPECT_EQ(kind_of_reading(folder / "large.json"), ErrorKind::limit);
}

}  // namespace voxelume
