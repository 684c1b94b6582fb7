// SPDX-License-Identifier: Apache-2.0
// The device memory that `check` promises, compared with the peak of a run, for every shipped scene
// and for built ones. Each test prints its row of a table.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <utility>

#include "runtime/analysis/culling.hpp"
#include "runtime/analysis/scene_choices.hpp"
#include "runtime/batch/render_frames.hpp"
#include "runtime/memory/frame_plans.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/shutter.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/memory/kept_promise.hpp"
#include "tests/pictures/small_scene.hpp"
#include "tests/support/display_fixture.hpp"
#include "tests/support/instance_scenes.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// On GPUs, whose batches hold whole small images.
constexpr double kMaxOfOneBatch = 1.6;

double promised(Scene scene, const std::vector<int>& frames, const Device& device) {
    AssetStore meshes;
    make_choices(scene, meshes);
    find_potentially_visible(scene, frames, meshes);
    const FramePlan planned = plan_frames(scene, frames, meshes, device.info());
    EXPECT_LE(planned.plan.min_bytes, planned.plan.peak_bytes());
    return planned.plan.run_bytes(worlds_of(scene, frames.size()), double(device.info().memory));
}

/// Renders a single image.
void expect_image_kept(const std::string& name, const Scene& scene, double max_ratio = kMaxRatio) {
    const Device device = test_device();
    const double promise = promised(scene, {1}, device);
    RenderReport report;
    render(device, scene, report);
    expect_kept(name, promise, device, max_ratio);
}

/// Waits until a device has done nothing for 0.3 seconds: mostly the next world is built by then.
void wait_until_quiet(const Device& device) {
    const auto taken = [&] {
        const auto lock = device.lock();
        return std::pair(device.counters().bytes_in_use, device.counters().launches);
    };
    for (auto before = taken();;) {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        auto now = taken();
        if (now == before) return;
        before = std::move(now);
    }
}

/// Renders frames as the command line does, on a machine where each takes longer to render than the
/// next one's world takes to build: so they overlap, which a promise has room for.
void expect_frames_kept(const std::string& name, Scene scene, const std::vector<int>& frames) {
    const Device device = test_device();
    const double promise = promised(scene, frames, device);
    // On a busy machine a world may take longer: then the height of up to five runs counts.
    for (int run = 0; run < 5; ++run) {
        std::set<int> held;
        const auto hold = [&](double, int frame) {
            if (frame != frames.back() && held.insert(frame).second) wait_until_quiet(device);
        };
        render_frames({device}, scene, {.frames = frames, .progress = hold},
                      [](const FrameResult&) {});
        if (promise <= kMaxRatio * double(device.counters().peak_bytes)) break;
    }
    expect_kept(name, promise, device, kMaxRatio);
}

class ShippedScene : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, TakesWhatIsPromised) {
    const Scene scene = small_scene(GetParam(), {96, 72}, 128);
    if (moves(scene)) return expect_frames_kept(GetParam(), scene, {1, 2, 3});
    expect_image_kept(GetParam(), scene);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene, testing::ValuesIn(shipped_scenes()),
                         [](const auto& name) { return name.param; });

TEST(BuiltScene, OfSeveralMomentsTakesWhatIsPromised) {
    using Case = std::pair<const char*, const char*>;
    const std::vector<Case> cases = {
        {"cubes", "instance"}, {"smooth", "world"}, {"exact", "world"}};
    for (const auto& [surface, placement] : in_turn(cases, 2)) {
        nlohmann::json json = nlohmann::json::parse(R"({"voxelume": 1,
"world": {"voxel_size": 0.01, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]}},
"models": {"ball": {"shape": "sphere", "radius": 0.4, "voxel_size": 0.01}},
"objects": [{"name": "a", "model": "ball"}, {"model": "ball", "position": [0.5, 0.5, 0]}],
"observer": {"position": [0, 0, -4], "shutter": 0.5, "display": {"shape": "pyramid", "angle": 40}},
"render": {"size": [200, 150], "samples": 8},
"animation": {"frames": 3, "tracks": [{"target": "objects.a.position",
    "keys": [{"frame": 1, "value": [-0.5, -0.3, 0]}, {"frame": 3, "value": [0.5, -0.2, 0]}]}]}})");
        json["models"]["ball"]["surface"] = surface;
        for (auto& object : json["objects"]) object["placement"] = placement;
        const Scene scene = parse_scene(json.dump(), "shutter.json", {});
        for (const std::vector<int>& frames : {std::vector{2}, std::vector{1, 2, 3}})
            expect_frames_kept(fmt::format("moments {} {}", surface, placement), scene, frames);
    }
}

TEST(BuiltScene, OfObjectsOfEachSurfaceInTheWorldAndAsInstancesTakesWhatIsPromised) {
    for (const char* surface : {"cubes", "smooth", "exact"})
        for (const char* placement : {"world", "instance"})
            expect_image_kept(fmt::format("{} {}", surface, placement),
                              instance_scene(surface, placement, turned_objects()));
}

TEST(BuiltScene, OfExactGlassTakesWhatIsPromised) {
    for (const int voxels : in_turn<int>({64, 128, 256}, 1)) {
        Scene scene = small_scene("glass_bunny", {96, 72}, voxels);
        for (Model& model : scene.models) model.surface = Surface::exact;
        expect_image_kept(fmt::format("exact glass, {} voxels", voxels), scene);
    }
}

TEST(BuiltScene, WithPassesOfItsLightTakesWhatIsPromised) {
    for (const bool has_color : in_turn<char>({true, false}, 0)) {
        Scene scene = small_scene("solids", {320, 240}, 64);
        scene.render.samples = 4;
        scene.render.channels = {has_color, false, false, false, false};
        scene.render.channels.albedo = scene.render.channels.shadow = true;
        // If one batch holds the image, its rays and hits are the ones that are retained.
        expect_image_kept(fmt::format("solids, {} and passes", has_color ? "color" : "no color"),
                          scene, test_device().is_cpu() ? kMaxRatio : kMaxOfOneBatch);
    }
}

TEST(BuiltScene, WhoseColorIsAddedForItsVarianceTakesWhatIsPromised) {
    Scene scene = small_scene("solids", {640, 480}, 64);
    scene.render.samples = 2;
    scene.render.channels = {false, false, false, false, false};
    scene.render.channels.variance = true;
    expect_image_kept("solids, variance", scene);
}

TEST(BuiltScene, WithMoreSamplesWherePixelsContrastTakesWhatIsPromised) {
    Scene scene = small_scene("cornell", {320, 240}, 64);
    scene.render.samples = 4;
    scene.render.adaptive = 1e-6;  // nearly all of them do, which is what is promised for
    expect_image_kept("cornell, adaptive", scene);
    scene.render.channels = {true, false, false, false, false};
    scene.render.channels.object_matte = scene.render.channels.albedo = true;
    expect_image_kept("cornell, adaptive with a matte and a pass", scene);
    crop(scene, {40, 40}, {200, 150});
    expect_image_kept("cornell, adaptive, a part", scene);
}

TEST(BuiltScene, OfMirrorsGlassEmissionAndMediaTakesWhatIsPromised) {
    constexpr const char* kFog =
        R"("medium": {"absorption": [0.4, 0.4, 0.4], "density": {"kind": "height", "base": 0, "scale_height": 0.3}},)";
    expect_image_kept("mirror",
                      promise_room(R"("reflection": 0.8)", R"("reflection": 0.5)", "", 0.02));
    expect_image_kept("glass", promise_room(R"("refraction": 0.9, "ior": 1.5)", "", "", 0.02));
    expect_image_kept("glass, exact",
                      promise_room(R"("refraction": 0.9, "ior": 1.5)", "", "", 0.02, "exact"));
    expect_image_kept("emissive", promise_room(R"("emission": [3, 2, 1])", "", "", 0.02));
    expect_image_kept("fog", promise_room("", "", kFog, 0.02));
    Scene global = promise_room(R"("emission": [3, 2, 1])", "", "", 0.02);
    global.render.light = LightMode::global;
    expect_image_kept("emissive, global", global);
    global.lights.resize(40, global.lights.front());
    expect_image_kept("many lights", global);
}

TEST(BuiltScene, OfSmoothSolidsOfSeveralPartsTakesWhatIsPromised) {
    for (const char* placement : {"world", "instance"})
        for (const char* shape : {"union", "difference"}) {
            const Scene scene = parsed(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.02, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}}}},
"models": {{"nut": {{"shape": "{}", "surface": "smooth", "voxel_size": 0.02, "parts": [
    {{"shape": "sphere", "radius": 0.7}}, {{"shape": "sphere", "radius": 0.6, "position": [0.3, 0.3, 0]}},
    {{"shape": "torus", "radius": 0.6, "tube": 0.2}}, {{"shape": "capsule", "radius": 0.2, "height": 1.2}}]}}}},
"objects": [{{"model": "nut", "placement": "{}"}}],
"observer": {{"position": [0.2, 0.4, -2.9], "look_at": [0, 0, 0], "display": {{"shape": "pyramid", "angles": [40, 40]}}}},
"render": {{"size": [100, 80]}}}})",
                                                   shape, placement));
            expect_image_kept(fmt::format("{} {}", shape, placement), scene);
        }
}

TEST(BuiltScene, OfManyEmissiveObjectsThatShareAModelTakesWhatIsPromised) {
    nlohmann::json scene = nlohmann::json::parse(R"({"voxelume": 1,
        "world": {"voxel_size": 0.05, "bounds": {"min": [-2, -2, -2], "max": [2, 2, 2]}},
        "materials": {"clay": {}, "lamp": {"emission": [6, 6, 6]}},
        "models": {"floor": {"shape": "box", "size": [3.8, 0.1, 3.8], "surface": "cubes"},
                   "shade": {"shape": "box", "size": [0.6, 0.5, 0.4], "surface": "cubes",
                             "voxel_size": 0.01}},
        "objects": [{"model": "floor", "material": "clay", "position": [0, -0.4, 0]}],
        "observer": {"position": [0, 0, -1.9],
                     "display": {"shape": "pyramid", "angle": 40}},
        "render": {"size": [24, 18], "samples": 1, "light": "global", "bounces": 1}})");
    for (int i = 0; i < 40; ++i)
        scene["objects"].push_back({{"model", "shade"},
                                    {"material", "lamp"},
                                    {"position", {0.7 * (i % 5) - 1.5, 0.6, 0.2 * (i / 5) - 1}},
                                    {"placement", "instance"}});
    expect_image_kept("instanced emissive objects", parsed(scene.dump()));
}

TEST(BuiltScene, OfALargeWorldTakesWhatIsPromised) {
    for (const char* surface : in_turn<const char*>({"cubes", "smooth", "exact"}, 1))
        expect_image_kept(fmt::format("large {}", surface),
                          promise_room("", "", "", 1.0 / 200, surface));
}

}  // namespace
}  // namespace voxelume
