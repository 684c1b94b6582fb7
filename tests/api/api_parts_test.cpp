// SPDX-License-Identifier: Apache-2.0
// Parts of images, what frames are made from, and files put together.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "tests/api/api_fixture.hpp"

namespace voxelume::v1 {
namespace {

namespace fs = std::filesystem;

class ApiParts : public ApiTest {
  protected:
    /// A box that turns, 20 x 13 pixels.
    static Scene turning_box() {
        SceneDescription room;
        room.world = {.voxel_size = uniform(0.1),
                      .min = {-1, -1, -1},
                      .max = {1, 1, 1},
                      .ambient = {0.3, 0.2, 0.1}};
        room.models = {{.name = "box", .source = Box{{0.8, 0.5, 0.3}}}};
        room.objects = {{.name = "box", .model = "box"}};
        room.observer = {.position = {0.4, 0.5, 3}, .look_at = Vec3{0, 0, 0}};
        room.animation = {
            .frames = 3,
            .tracks = {{"objects.box.turn", Keys<Vec3>{{1, {0, 0, 0}}, {3, {40, 20, 10}}}}}};
        room.render = {.size = {20, 13}, .samples = 2};
        return Scene::build(room);
    }

    void render(const Scene& scene, const fs::path& file, const ImageFileOptions& options = {}) {
        FrameJob job;
        job.frames = {{.frame = 2, .images = {file}}};
        job.image_files = options;
        render_frames(scene, *device, job);
    }

    static std::string text_of(const fs::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
};

TEST_F(ApiParts, MergedPartsHaveTheBytesOfTheWholeImage) {
    const Scene scene = turning_box();
    render(scene, folder / "whole.exr");
    render(scene, folder / "whole.png");
    const fs::path low = folder / "low.exr", high = folder / "high.exr";
    render(scene.with_crop({0, 0}, {20, 5}), high, {.float_color = true});
    render(scene.with_crop({0, 5}, {20, 8}), low, {.float_color = true});
    const std::string hash = frame_hashes(scene, {2}).front();
    merge_image_files({low, high}, {folder / "a.exr", folder / "a.png"}, hash);
    EXPECT_EQ(text_of(folder / "a.exr"), text_of(folder / "whole.exr"));
    EXPECT_EQ(text_of(folder / "a.png"), text_of(folder / "whole.png"));
    EXPECT_EQ(hash_of_file(folder / "a.png"), hash_of_file(folder / "whole.png"));
    EXPECT_THROW(merge_image_files({low, low}, {folder / "b.exr"}, hash), Error);
    EXPECT_EQ(hash_of_file(folder / "b.exr"), "");
}

TEST_F(ApiParts, ACropOutsideOfTheImageIsAnError) {
    EXPECT_THROW(static_cast<void>(turning_box().with_crop({0, 9}, {20, 5})), Error);
    EXPECT_EQ(turning_box().with_crop({3, 9}, {7, 4}).size(), (Size{7, 4}));
}

TEST_F(ApiParts, AFileIsCurrentForItsFrameAndForOptionsThatChangeIt) {
    const Scene scene = turning_box();
    const fs::path exr = folder / "a.exr", png = folder / "a.png";
    const std::vector<std::string> hashes = frame_hashes(scene, {1, 2});
    EXPECT_NE(hashes[0], hashes[1]);
    EXPECT_EQ(image_file_state(exr, hashes[1]), FrameFileState::missing);
    render(scene, exr);
    render(scene, png);
    EXPECT_EQ(image_file_state(exr, hashes[1]), FrameFileState::current);
    EXPECT_EQ(image_file_state(exr, hashes[0]), FrameFileState::stale);
    EXPECT_EQ(image_file_state(exr, hashes[1], {.exposure = 1}), FrameFileState::current);
    EXPECT_EQ(image_file_state(exr, hashes[1], {.float_color = true}), FrameFileState::stale);
    EXPECT_EQ(image_file_state(png, hashes[1], {.exposure = 1}), FrameFileState::stale);
    EXPECT_EQ(image_file_state(png, hashes[1], {.float_color = true}), FrameFileState::current);
    EXPECT_NE(frame_hashes(scene.with_samples(3), {2}), frame_hashes(scene, {2}));
    EXPECT_NE(frame_hashes(scene.with_crop({0, 0}, {9, 9}), {2}), frame_hashes(scene, {2}));
    fs::resize_file(exr, fs::file_size(exr) - 1);
    EXPECT_EQ(image_file_state(exr, hashes[1]), FrameFileState::damaged);
}

}  // namespace
}  // namespace voxelume::v1
