// SPDX-License-Identifier: Apache-2.0
// The library's errors tell programs by their values what the sentences tell people.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/api/api_environment.hpp"

namespace voxelume::v1 {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;
using testing::StartsWith;

/// The error that an action throws; an error of kind `render` if it throws none.
template <class Action>
Error error_of(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error;
    }
    return {ErrorKind::render, "no error"};
}

SceneDescription ball_scene() {
    SceneDescription scene;
    scene.name = "room";
    scene.world = {.voxel_size = uniform(0.1), .min = {-1, -1, -1}, .max = {1, 1, 1}};
    scene.models = {{.name = "ball", .source = Sphere{0.5}}};
    scene.objects = {{.model = "ball"}};
    scene.observer.emplace().position = {0, 0, -4};
    return scene;
}

/// The test's own folder, empty at first.
fs::path fresh_folder(const char* name) {
    const fs::path folder = fs::temp_directory_path() / (std::string("voxelume_") + name);
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}

}  // namespace

TEST(ApiErrors, NameThePlaceInAText) {
    const Error error = error_of([] {
        Scene::parse(R"({"voxelume": 1,
  "world": {"voxel_size": -1, "bounds": {"min": [0, 0, 0], "max": [1, 1, 1]}},
  "observer": {}})",
                     "room.json");
    });
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_EQ(error.exit_code(), 3);
    EXPECT_EQ(error.file(), "room.json");
    EXPECT_EQ(error.line(), 2);
    EXPECT_EQ(error.column(), 27);
    EXPECT_EQ(error.key(), "world.voxel_size");
    EXPECT_THAT(error.what(), StartsWith("room.json:2:27: world.voxel_size: "));
}

TEST(ApiErrors, NameThePlaceWhereATextIsNoJson) {
    const Error error = error_of([] { Scene::parse("{\n\"voxelume\" 1}", "room.json"); });
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_EQ(error.line(), 2);
    EXPECT_EQ(error.key(), "");
}

TEST(ApiErrors, NameTheKeyOfAStruct) {
    SceneDescription scene = ball_scene();
    scene.objects.push_back({.name = "second", .model = "bell"});
    const Error error = error_of([&] { Scene::build(scene); });
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_EQ(error.file(), "room");
    EXPECT_EQ(error.line(), 0);
    EXPECT_EQ(error.column(), 0);
    EXPECT_EQ(error.key(), "objects[1].model");
    EXPECT_STREQ(error.what(),
                 "room: objects[1].model: no model named \"bell\"; did you mean \"ball\"?");
}

TEST(ApiErrors, RefuseValuesThatNoFileCanHave) {
    SceneDescription scene = ball_scene();
    scene.objects[0].position = {0, std::nan(""), 0};
    EXPECT_EQ(error_of([&] { Scene::build(scene); }).key(), "objects[0].position[1]");
    scene = ball_scene();
    scene.models.push_back(scene.models[0]);
    EXPECT_THAT(error_of([&] { Scene::build(scene); }).what(),
                StartsWith("room: models: another of the models is named \"ball\" already"));
    scene = ball_scene();
    scene.models[0].name = "";
    EXPECT_THAT(error_of([&] { Scene::build(scene); }).what(), HasSubstr("must not be empty"));
    scene = ball_scene();
    scene.objects[0].matrix = Matrix{};
    scene.objects[0].position = {1, 0, 0};
    EXPECT_THAT(error_of([&] { Scene::build(scene); }).what(), HasSubstr("matrix"));
}

TEST(ApiErrors, KeepThePlaceAtALaterFrame) {
    SceneDescription scene = ball_scene();
    const Vec3 eye = scene.observer.value().position;
    const Keys<Vec3> through_it = {{1, {eye[0], eye[1], eye[2] - 1}},
                                   {3, {eye[0], eye[1], eye[2] + 1}}};
    scene.animation = {.frames = 3, .tracks = {{"observer.look_at", through_it, {}}}};
    const Scene moving = Scene::build(scene);
    const Error error =
        error_of([&] { plan(moving, Device::open(test_selector()), {.frames = {2}}); });
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_EQ(error.file(), "room");
    EXPECT_EQ(error.key(), "observer.look_at");
    EXPECT_THAT(error.what(), HasSubstr("(at frame 2)"));
}

TEST(ApiErrors, NameFilesThatAreMissingOrDamaged) {
    const fs::path folder = fresh_folder("api_errors");
    const Error missing = error_of([&] { Scene::load(folder / "no.json"); });
    EXPECT_EQ(missing.kind(), ErrorKind::input);
    EXPECT_EQ(missing.file(), (folder / "no.json").string());
    std::ofstream(folder / "bad.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 zero\nf 1 2 3\n";
    const Error mesh = error_of([&] { describe_file(folder / "bad.obj"); });
    EXPECT_EQ(mesh.kind(), ErrorKind::input);
    EXPECT_EQ(mesh.file(), (folder / "bad.obj").string());
    EXPECT_EQ(mesh.line(), 3);
    const Error image = error_of([&] { Image::read(folder / "bad.obj"); });
    EXPECT_EQ(image.kind(), ErrorKind::input);
    EXPECT_EQ(image.file(), (folder / "bad.obj").string());
    const Error output = error_of([&] { check_output_file(folder / "no" / "a.png"); });
    EXPECT_EQ(output.kind(), ErrorKind::output);
    EXPECT_EQ(output.file(), (folder / "no" / "a.png").string());
}

TEST(ApiErrors, SayWhyAWorldDoesNotFit) {
    SceneDescription scene = ball_scene();
    scene.world.voxel_size = uniform(2.0 / 65536);
    const Device device = Device::open(test_selector());
    const Error error = error_of([&] {
        const Plan planned = plan(Scene::build(scene), device);
        EXPECT_EQ(planned.verdict, Verdict::does_not_fit);
        if (planned.refusal) throw *planned.refusal;
    });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_EQ(error.key(), "world");
}

TEST(ApiErrors, RefuseToRenderNothingOrNowhere) {
    EXPECT_EQ(error_of([] { Device::open("no such device"); }).kind(), ErrorKind::device);
    EXPECT_EQ(error_of([] { render_image(Scene::build(ball_scene()), {}); }).kind(),
              ErrorKind::usage);
    EXPECT_EQ(error_of([] {
                  render_frames(Scene::build(ball_scene()), {Device::open(test_selector())}, {});
              }).kind(),
              ErrorKind::usage);
}

}  // namespace voxelume::v1
