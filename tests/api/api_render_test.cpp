// SPDX-License-Identifier: Apache-2.0
// Images and volumetric images that callers get: they are equal in memory and in files, callers
// learn of them while they are rendered, and rendering ends once nobody wants them.
#include <gmock/gmock.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "runtime/base/main_memory.hpp"
#include "tests/api/api_fixture.hpp"
#include "tests/support/setting.hpp"

extern char** environ;

namespace voxelume::v1 {
namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::HasSubstr;

class ApiRender : public ApiTest {
  protected:
    RenderOptions quick{.cache = {.enabled = false}};
};

/// The scene of a ball that rolls past a mirror, in seven frames of 40 x 24 pixels.
SceneDescription rolling_ball() {
    SceneDescription scene;
    scene.name = "rolling";
    scene.world = {.voxel_size = uniform(0.05),
                   .min = {-1, -1, -1},
                   .max = {1, 1, 1},
                   .ambient = {0.2, 0.2, 0.2}};
    scene.materials = {{.name = "red", .color = {0.7, 0.1, 0}},
                       {.name = "mirror", .color = {0.2, 0.2, 0.2}, .reflection = 0.5}};
    scene.models = {{.name = "ball", .source = Sphere{0.3}},
                    {.name = "plate", .source = Box{{1.6, 0.1, 1.2}}}};
    scene.objects = {{.name = "ball", .model = "ball", .material = "red"},
                     {.model = "plate", .material = "mirror", .position = {0, -0.6, 0}}};
    scene.lights = {{.source = PointLight{{0.5, 0.9, -0.8}}, .intensity = 2}};
    scene.observer = {.position = {0.2, 0.5, -3},
                      .look_at = Vec3{0, 0, 0},
                      .display = {.shape = PyramidDisplay{.near = 1, .far = 5},
                                  .voxels = std::array{20, 12, 32}}};
    scene.animation = {
        .frames = 7,
        .tracks = {{"objects.ball.position", Keys<Vec3>{{1, {-0.6, 0, 0}}, {7, {0.6, 0, 0}}}, {}}}};
    scene.render.size = {40, 24};
    return scene;
}

std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void expect_same(const Image& a, const Image& b) {
    ASSERT_EQ(a.channels(), b.channels());
    for (const std::string& name : a.channels()) {
        const auto p = a.plane(name), q = b.plane(name);
        ASSERT_EQ(p.size(), q.size());
        EXPECT_EQ(std::memcmp(p.data(), q.data(), p.size_bytes()), 0) << name;
    }
    EXPECT_TRUE(std::ranges::equal(a.object_ids(), b.object_ids()));
}

FrameJob job_of(std::initializer_list<int> frames) {
    FrameJob job;
    for (const int frame : frames) job.frames.push_back({.frame = frame});
    job.deliver_images = true;
    return job;
}

}  // namespace

TEST_F(ApiRender, GivesInMemoryWhatFilesHave) {
    const Scene scene = Scene::build(rolling_ball());
    FrameJob job;
    const fs::path exr = folder / "a.exr", png = folder / "a.png", deep = folder / "deep.exr";
    job.frames = {{.frame = 3, .images = {exr, png}, .volumes = {deep}}};
    job.image_files.float_color = true;
    const Statistics of_files = render_frames(scene, *device, job, quick);
    EXPECT_EQ(of_files.files, 3u);

    Statistics of_memory;
    const Image image = render_image(scene, *device, 3, quick, &of_memory);
    expect_same(image, Image::read(exr));
    EXPECT_EQ(of_memory.rays.sight_rays, 40u * 24u);
    const Volume volume = render_volume(scene, *device, 3, quick);
    const Volume read = Volume::read(deep);
    EXPECT_GT(volume.count(), 50u);
    EXPECT_TRUE(std::ranges::equal(volume.indices(), read.indices()));
    EXPECT_TRUE(std::ranges::equal(volume.object_ids(), read.object_ids()));

    image.write(folder / "b.exr", {.float_color = true});
    image.write(folder / "b.png");
    volume.write(folder / "deep2.exr");
    EXPECT_EQ(bytes_of(folder / "b.exr"), bytes_of(exr));
    EXPECT_EQ(bytes_of(folder / "b.png"), bytes_of(png));
    EXPECT_EQ(bytes_of(folder / "deep2.exr"), bytes_of(deep));
}

TEST_F(ApiRender, ComputesAndWritesTheChannelsThatAreAskedFor) {
    const Scene scene = Scene::build(rolling_ball());
    RenderOptions options = quick;
    options.channels = {false, true, false, false, false};
    const Image depth = render_image(scene, *device, 1, options);
    EXPECT_THAT(depth.channels(), ElementsAre("Z"));
    EXPECT_TRUE(depth.object_ids().empty());
    EXPECT_THROW(depth.plane("R"), Error);
    FrameJob job;
    job.frames = {{.frame = 1, .images = {folder / "a.exr", folder / "a.png"}}};
    job.image_files.channels = options.channels;
    EXPECT_TRUE(needed_channels(job).color);
    render_frames(scene, *device, job, quick);
    EXPECT_THAT(Image::read(folder / "a.exr").channels(), ElementsAre("Z"));
    std::vector<float> copied(40 * 24);
    depth.copy("Z", copied);
    EXPECT_EQ(std::memcmp(copied.data(), depth.plane("Z").data(), sizeof(float) * copied.size()),
              0);
    EXPECT_THROW(depth.copy("Z", std::span(copied).first(3)), Error);
}

TEST_F(ApiRender, DeliversFramesInOrderAndTellsOfProgress) {
    const Scene scene = Scene::build(rolling_ball());
    FrameJob job = job_of({5, 1, 2});
    std::vector<int> delivered;
    std::vector<Image> images;
    job.deliver = [&](const RenderedFrame& rendered) {
        delivered.push_back(rendered.frame);
        EXPECT_EQ(rendered.statistics.frame, rendered.frame);
        EXPECT_FALSE(rendered.volume);
        images.push_back(rendered.image.value());
    };
    RenderOptions options = quick;
    std::vector<double> shares;
    options.progress = [&](double done, int) { shares.push_back(done); };
    const Statistics statistics = render_frames(scene, *device, job, options);
    EXPECT_THAT(delivered, ElementsAre(5, 1, 2));
    ASSERT_FALSE(shares.empty());
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_EQ(shares.back(), 1);
    EXPECT_EQ(statistics.frames.size(), 3u);
    EXPECT_THAT(to_json(statistics), HasSubstr("\"sight_rays\": 2880"));
    // Images outlive the run, and don't depend on the frames before.
    expect_same(images[1], render_image(scene, *device, 1, quick));
}

TEST_F(ApiRender, StopsWhenAskedTo) {
    const Scene scene = Scene::build(rolling_ball());
    std::stop_source stop;
    RenderOptions options = quick;
    options.stop = stop.get_token();
    FrameJob job = job_of({1, 2, 3, 4, 5, 6, 7});
    int delivered = 0;
    job.deliver = [&](const RenderedFrame&) {
        if (++delivered == 2) stop.request_stop();
    };
    try {
        render_frames(scene, *device, job, options);
        ADD_FAILURE() << "it went on to the end";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::cancelled);
        EXPECT_EQ(error.exit_code(), 130);
    }
    EXPECT_LT(delivered, 7);
    // After the stop the device works as before.
    EXPECT_EQ(render_image(scene, *device, 1, quick).width(), 40);
}

TEST_F(ApiRender, LetsExceptionsOfCallbacksThrough) {
    struct Enough {};
    const Scene scene = Scene::build(rolling_ball());
    FrameJob job = job_of({1, 2});
    job.deliver = [](const RenderedFrame&) { throw Enough(); };
    EXPECT_THROW(render_frames(scene, *device, job, quick), Enough);
    RenderOptions options = quick;
    options.progress = [](double, int) { throw std::out_of_range("enough"); };
    EXPECT_THROW(render_image(scene, *device, 1, options), std::out_of_range);
}

TEST_F(ApiRender, TellsOfWarningsOnceAndMakesErrorsOfThemIfAsked) {
    SceneDescription description = rolling_ball();
    description.objects.push_back({.name = "far", .model = "ball", .position = {0, 7, 0}});
    const Scene scene = Scene::build(description);
    std::vector<std::string> heard;
    RenderOptions options = quick;
    options.warn = [&](const Warning& warning) { heard.push_back(warning.where); };
    const Statistics statistics = render_frames(scene, *device, job_of({1, 2, 3}), options);
    EXPECT_THAT(heard, ElementsAre("rolling: objects[2]"));
    ASSERT_EQ(statistics.warnings.size(), 1u);
    EXPECT_EQ(statistics.warnings[0].kind, WarningKind::outside_world);
    EXPECT_STREQ(name_of(statistics.warnings[0].kind), "outside_world");
    EXPECT_THAT(statistics.warnings[0].text, HasSubstr("\"far\" lies outside the world"));
    EXPECT_EQ(plan(scene, device->front()).warnings.size(), 1u);
    options.strict = true;
    options.progress = [](double, int) { FAIL() << "a frame was begun"; };
    try {
        render_image(scene, *device, 1, options);
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::scene);
        EXPECT_EQ(error.key(), "objects[2]");
        EXPECT_THAT(error.what(), HasSubstr("lies outside the world"));
    }
    options.warn = [](const Warning&) { throw std::out_of_range("enough"); };
    EXPECT_THROW(render_image(scene, *device, 1, options), std::out_of_range);
}

TEST_F(ApiRender, PrintsNothingAndLeavesTheEnvironment) {
    const auto variables = [] {
        std::vector<std::string> list;
        for (char** variable = environ; *variable; ++variable) list.emplace_back(*variable);
        return list;
    };
    const std::vector<std::string> before = variables();
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const Scene scene = Scene::build(rolling_ball());
    plan(scene, device->front());
    FrameJob job = job_of({1, 2});
    job.frames[0].images = {folder / "a.png"};
    render_frames(scene, *device, job, quick);
    EXPECT_THROW(Scene::load("no such file"), Error);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(variables(), before);
}

TEST_F(ApiRender, ComparesAndDescribesWhatItWrote) {
    const Scene scene = Scene::build(rolling_ball());
    const Image one = render_image(scene, *device, 1, quick);
    const Image two = render_image(scene, *device, 2, quick);
    const ImageDifference same = compare(one, one);
    EXPECT_EQ(same.flip, 0.0);
    for (const ChannelDifference& channel : same.channels) EXPECT_EQ(channel.differing, 0u);
    EXPECT_GT(compare(one, two).flip.value_or(0), 0.0);
    limit_main_memory(1);
    EXPECT_FALSE(compare(one, two).flip) << "memory has no room for it";
    EXPECT_THROW(flip_image(one, two), Error);
    limit_main_memory(0);
    one.write(folder / "a.exr");
    const Facts facts = describe_file(folder / "a.exr");
    ASSERT_EQ(facts.kind, Facts::Kind::object);
    const auto& members = std::get<std::vector<Facts>>(facts.value);
    const auto kind = std::ranges::find(members, "kind", &Facts::name);
    ASSERT_NE(kind, members.end());
    EXPECT_EQ(std::get<std::string>(kind->value), "OpenEXR image");
    const Image sheet = render_volume(scene, *device, 1, quick).view({}, {128, 96});
    EXPECT_EQ(sheet.width(), 128);
    EXPECT_THROW(sheet.write(folder / "a.gif"), Error);
}

}  // namespace voxelume::v1
