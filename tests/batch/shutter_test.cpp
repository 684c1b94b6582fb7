// SPDX-License-Identifier: Apache-2.0
// Images whose samples show several moments, against each moment rendered alone.
#include <gmock/gmock.h>

#include <algorithm>
#include <optional>
#include <set>

#include "tests/batch/blurred_frames.hpp"

namespace voxelume {
namespace {

TEST(Shutter, SamplesAreTakenAtMomentsOfTheirOwn) {
    const Scene scene = scene_of(blurred_json());
    const Rendered blurred = rendered(scene);
    EXPECT_EQ(blurred.report.moments, uint32_t(kSamples));
    const std::vector<Image> samples = samples_alone(scene);
    for (const char* plane : {"R", "G", "B", "A"}) expect_means(*blurred.image, samples, plane);
    EXPECT_EQ(blurred.report.sight_rays, uint64_t(kSamples) * 48 * 32);
}

TEST(Shutter, GeometryIsThatOfTheFirstSampleThatMeetsSomething) {
    const Scene scene = scene_of(blurred_json());
    const Image image = *rendered(scene).image;
    const std::vector<Image> samples = samples_alone(scene);
    std::set<size_t> chosen;
    for (size_t pixel = 0; pixel < image.id_planes.at("objectId").size(); ++pixel) {
        size_t first = 0;
        while (first + 1 < samples.size() && samples[first].id_planes.at("objectId")[pixel] == 0)
            ++first;
        chosen.insert(first);
        for (const char* plane : {"Z", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z"})
            ASSERT_EQ(image.planes.at(plane)[pixel], samples[first].planes.at(plane)[pixel])
                << plane << " of " << pixel;
        ASSERT_EQ(image.id_planes.at("objectId")[pixel],
                  samples[first].id_planes.at("objectId")[pixel]);
    }
    EXPECT_GT(chosen.size(), 3u);
}

TEST(Shutter, FramesWhereNothingMovesTakeWhatTheyTakeWithoutOne) {
    Json json = blurred_json();
    const Scene open = scene_of(json);
    json["observer"].erase("shutter");
    const Scene closed = scene_of(json);
    const std::vector<Rendered> still = rendered_frames(open, {.frames = {9, 10}});
    EXPECT_EQ(still[0].report.moments, 0u);
    EXPECT_TRUE(still[1].report.is_kept);
    EXPECT_EQ(oracle::image_hash(*still[0].image), hash_of(closed, 9));
}

TEST(Shutter, AWorldIsBuiltOnceWhereOnlyLightAndObserverMove) {
    Json json = blurred_json();
    json["animation"]["tracks"].erase(0);
    json["animation"]["tracks"].erase(0);
    const Rendered blurred = rendered(scene_of(json));
    EXPECT_EQ(blurred.report.moments, uint32_t(kSamples));
    json["observer"].erase("shutter");
    const Rendered sharp = rendered(scene_of(json));
    EXPECT_EQ(blurred.report.world.painted_bricks, sharp.report.world.painted_bricks);
    EXPECT_EQ(blurred.report.world.voxelized, sharp.report.world.voxelized);
}

TEST(Shutter, InstancesMoveAndModelsAreVoxelizedOnce) {
    Json json = blurred_json();
    json["animation"]["tracks"].erase(1);
    const Rendered blurred = rendered(scene_of(json));
    EXPECT_EQ(blurred.report.world.voxelized, 3u);
    EXPECT_GE(blurred.report.world.instances.moved, uint32_t(kSamples));
    json["observer"].erase("shutter");
    EXPECT_EQ(blurred.report.world.painted_bricks,
              rendered(scene_of(json)).report.world.painted_bricks);
}

TEST(Shutter, BitsDependNeitherOnLanesNorOnOtherFramesNorOnDevices) {
    const Scene scene = scene_of(blurred_json());
    const uint64_t hash = hash_of(scene);
    for (const int lanes : lanes_with_all()) EXPECT_EQ(hash_of(scene, kFrame, lanes), hash);
    const std::vector<Rendered> frames = rendered_frames(scene, {.frames = {2, kFrame, 4}});
    EXPECT_EQ(oracle::image_hash(*frames[1].image), hash);
    render_frames(halves(), scene, {.frames = {kFrame}}, [&](const FrameResult& result) {
        EXPECT_EQ(oracle::image_hash(*result.image), hash);
        EXPECT_EQ(result.report.report.sight_rays, uint64_t(kSamples) * 48 * 32);
    });
}

TEST(Shutter, VolumetricImagesShowTheFrameItself) {
    Json json = blurred_json();
    const Scene open = scene_of(json);
    json["observer"].erase("shutter");
    const auto volume_of = [](const Scene& scene, bool image) {
        return rendered_frames(scene, {.frames = {kFrame}, .image = image, .volume = true})[0]
            .volume;
    };
    const std::shared_ptr<Volume> both = volume_of(open, true);
    const std::shared_ptr<Volume> sharp = volume_of(scene_of(json), false);
    ASSERT_TRUE(both && sharp);
    EXPECT_FALSE(sharp->indices.empty());
    EXPECT_EQ(both->indices, sharp->indices);
    EXPECT_EQ(both->colors, sharp->colors);
    EXPECT_EQ(both->depths, sharp->depths);
    EXPECT_EQ(both->objects, sharp->objects);
}

TEST(Shutter, ShowsWhatIsInViewAtOtherMomentsAlone) {
    Json json = blurred_json();
    json["observer"]["shutter"] = 1;
    // The ball comes from outside the view, and is back there with the next frame.
    json["animation"]["tracks"] = {{{"target", "objects.ball.position"},
                                    {"keys",
                                     {{{"frame", kFrame}, {"value", {-0.6, 0.6, -0.9}}},
                                      {{"frame", kFrame + 0.5}, {"value", {0, 0, -0.3}}},
                                      {{"frame", kFrame + 1}, {"value", {-0.6, 0.6, -0.9}}}}}}};
    json["objects"].erase(2);
    json["observer"]["display"]["angles"] = {4, 4};
    Scene scene = scene_of(json);
    scene.render.shadows = false;
    const Image image = *rendered(scene).image;
    const Plane<float>& covered = image.planes.at("A");
    EXPECT_GT(*std::ranges::max_element(covered), 0.2f);
    EXPECT_LT(*std::ranges::max_element(covered), 0.9f);
}

TEST(Shutter, ProgressRisesToItsEnd) {
    std::vector<double> parts;
    BatchOptions options{.frames = {kFrame}};
    options.progress = [&](double done, int) { parts.push_back(done); };
    rendered_frames(scene_of(blurred_json()), options);
    EXPECT_TRUE(std::ranges::is_sorted(parts));
    EXPECT_GE(parts.size(), size_t(kSamples));
    ASSERT_GE(parts.size(), 2u);
    EXPECT_LT(parts[parts.size() - 2], 1);
    EXPECT_EQ(parts.back(), 1);
}

/// A scene in which nothing that is seen moves, but something does: a material that no object has.
TEST(Shutter, MomentsThatLookAlikeHaveTheBitsOfOne) {
    for (const char* light : {"local", "global"}) {
        Json json = blurred_json();
        json["render"]["light"] = light;
        json["world"]["sky"] = {{"kind", "gradient"}, {"zenith", {0.2, 0.3, 0.5}}};
        json["materials"]["blue"]["reflection"] = 0.3;
        json["materials"]["unused"] = {{"color", {0, 0, 0}}};
        json["animation"]["tracks"] =
            Json::array({track("materials.unused.color", {0, 0, 0}, {1, 1, 1})});
        Scene open = scene_of(json);
        json["observer"].erase("shutter");
        Scene closed = scene_of(json);
        for (Scene* scene : {&open, &closed}) {
            ImageChannels& channels = scene->render.channels;
            channels.object_matte = channels.material_matte = channels.material = true;
            channels.distance = channels.direct = channels.shadow = channels.light_groups = true;
        }
        const Rendered blurred = rendered(open);
        EXPECT_EQ(blurred.report.moments, uint32_t(kSamples));
        EXPECT_EQ(oracle::image_hash(*blurred.image), hash_of(closed)) << light;
    }
}

/// Two devices, each with so little memory, that share an image. Nothing: it doesn't suffice.
std::optional<Rendered> shared_image(const Scene& scene, uint64_t megabytes) {
    const std::vector<Device> small = {device_with_memory(megabytes),
                                       device_with_memory(megabytes)};
    Rendered shared;
    try {
        render_frames(small, scene, {.frames = {kFrame}}, [&](const FrameResult& result) {
            shared = {result.image, nullptr, result.report.report};
        });
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::limit) << error.what();
        return std::nullopt;
    }
    for (const Device& device : small) EXPECT_LE(device.counters().peak_bytes, megabytes << 20);
    return shared;
}

/// If memory doesn't suffice for what is retained of earlier moments, it is released.
TEST(Shutter, MomentsNeedNoMoreMemoryThanOne) {
    Json json = blurred_json();
    json["world"]["voxel_size"] = json["models"]["ball"]["voxel_size"] = 0.01;
    for (Json& object : json["objects"]) object["placement"] = "world";
    const Scene open = scene_of(json);
    json["observer"].erase("shutter");
    const Scene closed = scene_of(json);
    const uint64_t hash = hash_of(open);
    int fits = 0, forgets = 0;
    for (uint64_t megabytes = 26; megabytes < 29; ++megabytes) {
        if (!shared_image(closed, megabytes)) continue;
        const std::optional<Rendered> blurred = shared_image(open, megabytes);
        ASSERT_TRUE(blurred) << megabytes;
        EXPECT_EQ(oracle::image_hash(*blurred->image), hash) << megabytes;
        ++fits;
        forgets += int(blurred->report.world.lacks_room);
    }
    EXPECT_GT(fits, forgets);
    EXPECT_GT(forgets, 0);
}

}  // namespace
}  // namespace voxelume
