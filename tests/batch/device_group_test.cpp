// SPDX-License-Identifier: Apache-2.0
// Several devices that share an animation's frames or an image's tiles give the bits of one device.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>

#include "runtime/batch/frame_schedule.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/stages/trace/sight.hpp"
#include "tests/batch/device_image.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

Scene scene_with(double x, int samples = 1) {
    constexpr const char* kText = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]},
          "background": [0.2, 0.3, 0.5]},
"materials": {"mirror": {"reflection": 0.6, "diffuse": 0.3}},
"models": {"ball": {"shape": "sphere", "radius": 0.4, "voxel_size": 0.05, "surface": "smooth"}},
"objects": [{"name": "a", "model": "ball", "material": "mirror"},
            {"name": "b", "model": "ball", "position": [0.5, 0.2, 0.1]}],
"lights": [{"type": "point", "position": [1, 3, -3], "intensity": 20}],
"observer": {"position": [0, 0.5, -5], "look_at": [0, 0, 0],
             "display": {"shape": "pyramid", "angles": [50, 40], "near": 0.5, "far": 20,
                         "voxels": [8, 8, 8]}},
"render": {"size": [61, 43]}})";
    Scene scene = parse_scene(kText, "test.json", {});
    scene.objects[0].world_from_object[3].x = x;
    scene.render.samples = samples;
    return scene;
}

/// The halves of the CPU; only the whole device where it has a single compute unit.
std::vector<Device> halves() {
    const Device whole = test_device();
    const bool is_cut = whole.is_cpu() && whole.info().compute_units > 1;
    return is_cut ? Device::open_all("all/2") : std::vector{whole};
}

uint64_t hash_of_scene(const Scene& scene) {
    RenderReport report;
    return oracle::image_hash(render(test_device(), scene, report));
}

TEST(DeviceGroup, TheTilesOfAnImageMakeTheImageOfOneDevice) {
    for (const int samples : {1, 3}) {
        const Scene scene = scene_with(-0.3, samples);
        RenderReport alone, together;
        const Image expected = render(test_device(), scene, alone);
        constexpr double kTiles = 16 * 11;
        double last = 0;
        const auto image = image_by(halves(), scene, together, [&](double done, int frame) {
            EXPECT_GT(done, last);
            EXPECT_NEAR(done * kTiles, std::round(done * kTiles), 1e-3);
            EXPECT_EQ(frame, 1);
            last = done;
        });
        EXPECT_EQ(oracle::image_hash(*image), oracle::image_hash(expected)) << samples;
        EXPECT_EQ(last, 1);
        EXPECT_EQ(together.sight_rays, alone.sight_rays);
        EXPECT_EQ(together.shadow_rays, alone.shadow_rays);
        EXPECT_EQ(together.secondary_rays, alone.secondary_rays);
        EXPECT_EQ(together.voxels, alone.voxels);
    }
}

/// The scene has mirrors, but nothing that light passes. Once, a second batch's rays found no
/// arrays in such a scene.
TEST(DeviceGroup, OneDeviceMakesTheImageInParts) {
    const Scene scene = scene_with(0.1);
    RenderReport report;
    const BuiltWorld world = WorldBuilder(test_device(), false).build(scene, report.world);
    TileShare share(tile_count(61, 43), {}, 11);
    std::vector<TileRange> tiles;
    const Image image =
        Renderer(test_device(), false).part_of_image(scene, world, report, {share, tiles});
    EXPECT_EQ(tiles.size(), 16u);
    EXPECT_EQ(oracle::image_hash(image), hash_of_scene(scene));
}

TEST(DeviceGroup, DevicesWithOtherLanesMakeTheSameImage) {
    const Scene scene = scene_with(0.1);
    RenderReport report;
    EXPECT_EQ(oracle::image_hash(*image_by({test_device(), test_device(1)}, scene, report)),
              hash_of_scene(scene));
}

TEST(DeviceGroup, AnErrorOfOneDeviceIsTheImagesError) {
    Scene scene = scene_with(0);
    scene.world.voxels = glm::ivec3(60000);
    RenderReport report;
    try {
        image_by(halves(), scene, report);
        ADD_FAILURE() << "it fits";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::limit) << error.what();
    }
}

/// The frames of several devices, and what was written of them.
struct SharedFrames {
    std::vector<size_t> written;
    std::vector<uint64_t> hashes;
    std::atomic<size_t> rendered = 0;
    size_t failing_image = SIZE_MAX, failing_file = SIZE_MAX;

    void run(const std::vector<Device>& devices, size_t count) {
        std::vector<Renderer> renderers;
        for (const Device& device : devices) renderers.emplace_back(device);
        const auto show = [&](const FrameInput& input) -> std::function<void()> {
            ++rendered;
            const size_t frame = input.frame;
            if (frame >= failing_image) throw std::runtime_error(std::to_string(frame));
            RenderReport report;
            const uint64_t hash = oracle::image_hash(
                *renderers.at(input.device).image(input.scene, input.world, report));
            return [this, frame, hash] {
                if (frame >= failing_file) throw std::runtime_error(std::to_string(frame));
                written.push_back(frame);
                hashes.push_back(hash);
            };
        };
        run_frames(devices, count,
                   {[](size_t frame) { return scene_with(0.05 * double(frame / 2) - 0.4); }, show},
                   {});
    }
};

TEST(DeviceGroup, FramesOfTwoDevicesAreThoseOfOneInOrder) {
    SharedFrames one, two;
    one.run({test_device()}, 9);
    two.run(halves(), 9);
    EXPECT_EQ(one.written, two.written);
    EXPECT_EQ(one.hashes, two.hashes);
    EXPECT_EQ(two.hashes.size(), 9u);
    for (size_t frame = 0; frame < 9; ++frame)
        EXPECT_EQ(two.hashes[frame], hash_of_scene(scene_with(0.05 * double(frame / 2) - 0.4)));
}

TEST(DeviceGroup, TheFirstErrorInOrderEndsTheRunAfterTheFramesBeforeIt) {
    for (const bool file : {false, true}) {
        SharedFrames frames;
        (file ? frames.failing_file : frames.failing_image) = 4;
        try {
            frames.run(halves(), 50);
            ADD_FAILURE() << "nothing failed";
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "4");
        }
        EXPECT_EQ(frames.written.size(), 4u);
        EXPECT_LE(frames.rendered, 12u);
    }
}

TEST(DeviceGroup, AllIsChosenByName) {
    if (!test_device().is_cpu()) GTEST_SKIP() << "only CPUs are cut";
    EXPECT_GE(Device::open_all("all").size(), 1u);
    EXPECT_EQ(Device::open_all("cpu").size(), 1u);
    EXPECT_EQ(Device::open("all").info().index, Device::open("auto").info().index);
    const Device whole = Device::open("cpu");
    const std::vector<Device> devices = halves();
    if (devices.size() < 2) GTEST_SKIP() << "a device that can't be cut";
    for (const Device& part : devices) {
        EXPECT_EQ(part.info().name, whole.info().name);
        EXPECT_EQ(part.info().compute_units, whole.info().compute_units / 2);
        EXPECT_EQ(part.info().memory, whole.info().memory / 2);
    }
    for (const char* selector : {"all/0", "all/-2", "all/x", "all/", "all/100000"}) {
        try {
            Device::open_all(selector);
            ADD_FAILURE() << selector;
        } catch (const Error& error) {
            const bool can_be_read = selector == std::string_view("all/100000");
            EXPECT_EQ(error.kind(), can_be_read ? ErrorKind::device : ErrorKind::usage) << selector;
        }
    }
}

using DeviceGroupProgram = ProgramTest;

TEST_F(DeviceGroupProgram, WritesTheFilesOfOneDevice) {
    if (!test_device().is_cpu() || test_device().info().compute_units < 2)
        GTEST_SKIP() << "a device that can't be cut";
    const std::string scene = fmt::format("'{}/scenes/lamp.json'", VXL_SOURCE_DIR);
    for (const char* device : {"cpu", "all/2"}) {
        const std::string name = device == std::string("cpu") ? "one" : "two";
        const ProgramResult image = run(fmt::format(
            "render {} --size 40x30 -q --float -o {}.exr --device {}", scene, name, device));
        EXPECT_EQ(image.exit_code, 0) << image.err;
        const ProgramResult frames = run(
            fmt::format("render {} --frames 3-7 --size 40x30 -q --float -o {}.#.exr --device {}",
                        scene, name, device));
        EXPECT_EQ(frames.exit_code, 0) << frames.err;
    }
    // Each device takes its frames in turn, even without overlap.
    const ProgramResult in_turn = run(
        fmt::format("render {} --frames 3-7 --size 40x30 -q --float -o three.#.exr --device all/2 "
                    "--no-overlap",
                    scene));
    EXPECT_EQ(in_turn.exit_code, 0) << in_turn.err;
    for (int frame = 3; frame <= 7; ++frame)
        EXPECT_TRUE(bytes_of(folder / fmt::format("one.{}.exr", frame)) ==
                    bytes_of(folder / fmt::format("three.{}.exr", frame)));
    EXPECT_TRUE(bytes_of(folder / "one.exr") == bytes_of(folder / "two.exr"));
    for (int frame = 3; frame <= 7; ++frame)
        EXPECT_TRUE(bytes_of(folder / fmt::format("one.{}.exr", frame)) ==
                    bytes_of(folder / fmt::format("two.{}.exr", frame)))
            << frame;
}

}  // namespace
}  // namespace voxelume
