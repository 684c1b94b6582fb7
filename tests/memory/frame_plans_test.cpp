// SPDX-License-Identifier: Apache-2.0
// Frames of a moving scene, planned before the first is rendered.
#include "runtime/memory/frame_plans.hpp"
#include "runtime/memory/count/solid_extents.hpp"
#include "runtime/scene_file/read_scene.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numeric>

#include "runtime/scene/scene_animation.hpp"
#include "tests/memory/plan_fixture.hpp"

namespace voxelume {

using testing::HasSubstr;

using FramePlans = PlanTest;

/// A ball whose radius grows from frame 1 to 3 and is small again in frame 5.
constexpr const char* kGrowth = R"("animation": {"frames": 5, "tracks": [
    {"target": "models.thing.radius", "keys": [{"frame": 1, "value": 0.1}, {"frame": 3, "value": 0.35},
                                               {"frame": 5, "value": 0.1}]}]},)";

TEST_F(FramePlans, OfFramesTheLargestCountsAndTheFirstThatDoesNotFitIsNamed) {
    const Scene scene =
        scene_of(R"({"shape": "sphere", "radius": 0.1, "surface": "smooth"})", 1.0 / 200, kGrowth);
    DeviceInfo device;
    device.name = "Small One";
    device.memory = device.max_allocation = 8'000'000'000;
    const std::vector<int> frames = {1, 2, 3, 4, 5};
    AssetStore meshes;
    const FramePlan maximum = plan_frames(scene, frames, meshes, device);
    EXPECT_EQ(maximum.frame, 3);
    EXPECT_EQ(maximum.plan.peak_bytes(), plan_of(scene_at(scene, 3)).peak_bytes());
    EXPECT_NO_THROW(check_frames(scene, frames, meshes, device));
    // The first frame takes 0.9 MB, the second 4.0 MB, the third 9.4 MB.
    device.memory = 3'000'000;
    EXPECT_EQ(plan_frames(scene, frames, meshes, device).frame, 2);
    const Error error = error_of([&] { check_frames(scene, frames, meshes, device); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_THAT(error.what(), testing::EndsWith("(at frame 2)"));
    EXPECT_NO_THROW(check_frames(scene, std::vector<int>{1, 5}, meshes, device));
}

DeviceInfo roomy_device() {
    DeviceInfo device;
    device.memory = device.max_allocation = 8'000'000'000;
    return device;
}

std::vector<int> first_frames(int count) {
    std::vector<int> frames(static_cast<size_t>(count));
    std::iota(frames.begin(), frames.end(), 1);
    return frames;
}

constexpr const char* kBall = R"({"shape": "sphere", "radius": 0.1, "surface": "smooth"})";

/// An animation of 6000 frames in which the radius has a key in each frame that `step` divides.
/// `more` are other tracks.
template <class Radius>
std::string keyed_radius(int step, const Radius& radius, const std::string& more = "") {
    std::string keys;
    for (int frame = step; frame <= 6000; frame += step)
        keys += fmt::format("{}{{\"frame\": {}, \"value\": {}}}", keys.empty() ? "" : ", ", frame,
                            radius(frame));
    return fmt::format(R"("animation": {{"frames": 6000, "tracks": [
        {{"target": "models.thing.radius", "keys": [{}]}}{}]}},)",
                       keys, more);
}

// Few of the radius's 2000 keys are planned for their own sake. It is largest in frame 15, which
// shows nothing, and of the frames that show the ball in frame 3000.
TEST_F(FramePlans, OfThousandsSomeAreMadeAndTheLargestIsFound) {
    const auto radius = [](int frame) {
        return frame == 15 ? 0.6 : 0.1 + 0.25 * std::exp(-std::pow((frame - 3000) / 400.0, 2));
    };
    constexpr const char* kHidden =
        R"(, {"target": "objects[0].visible", "keys": [{"frame": 1, "value": true},
            {"frame": 10, "value": false}, {"frame": 20, "value": true}]})";
    const Scene scene = scene_of(kBall, 1.0 / 30, keyed_radius(3, radius, kHidden));
    AssetStore meshes;
    size_t last = 0;
    const FramePlan maximum =
        plan_frames(scene, first_frames(6000), meshes, roomy_device(), [&](size_t done) {
            EXPECT_GE(done, last);
            last = done;
        });
    EXPECT_LT(last, 6000u);
    EXPECT_FALSE(maximum.is_of_all);
    EXPECT_LE(maximum.plans, 2048 + 16);
    double largest = 0;
    for (int frame = 2990; frame <= 3010; ++frame)
        largest = std::max(largest, plan_of(scene_at(scene, frame)).peak_bytes());
    EXPECT_EQ(maximum.plan.peak_bytes(), largest);
    DeviceInfo small = roomy_device();
    small.memory = size_t(largest * 0.3);
    const FramePlan refused = plan_frames(scene, first_frames(6000), meshes, small);
    EXPECT_TRUE(is_refused(refused, small));
    EXPECT_EQ(error_of([&] { check_frames(scene, first_frames(6000), meshes, small); }).kind(),
              ErrorKind::limit);
}

TEST_F(FramePlans, OfThousandsTheKeysAreMade) {
    const Scene scene =
        scene_of(R"({"shape": "sphere", "radius": 0.1, "surface": "smooth"})", 1.0 / 30,
                 R"("animation": {"frames": 6000, "tracks": [
        {"target": "models.thing.radius", "keys": [
            {"frame": 1, "value": 0.1}, {"frame": 4600, "value": 0.2}, {"frame": 4601, "value": 0.35},
            {"frame": 4602, "value": 0.2}, {"frame": 6000, "value": 0.1}]}]},)");
    AssetStore meshes;
    EXPECT_EQ(plan_frames(scene, first_frames(6000), meshes, roomy_device()).frame, 4601);
}

TEST_F(FramePlans, OfThousandsOfKeysTheExtremeOnesAreMade) {
    const auto radius = [](int frame) { return frame == 3334 ? 0.35 : 0.1 + 1e-5 * (frame % 7); };
    const Scene scene = scene_of(kBall, 1.0 / 30, keyed_radius(2, radius));
    AssetStore meshes;
    EXPECT_EQ(plan_frames(scene, first_frames(6000), meshes, roomy_device()).frame, 3334);
}

// The observer looks at himself in frame 5001 alone.
TEST_F(FramePlans, OfThousandsAllAreHeldAgainstTheRulesForValues) {
    constexpr const char* kTracks = R"("animation": {{"frames": 6000, "tracks": [
        {{"target": "models.thing.radius", "keys": [
            {{"frame": 1, "value": 0.1}}, {{"frame": 6000, "value": 0.2}}]}},
        {{"target": "observer.position", "keys": [
            {{"frame": 1, "value": [0.5, 0.5, -3]}}, {{"frame": 6000, "value": [0.5, 0.5, 3]}}]}},
        {{"target": "observer.look_at", "keys": [
            {{"frame": 1, "value": [0.5, 0.5, {0}]}}, {{"frame": 6000, "value": [0.5, 0.5, {0}]}}]}}]}},)";
    const double z = -3 + 6.0 * 5000 / 5999;  // where the observer is in frame 5001
    const Scene scene = scene_of(R"({"shape": "sphere", "radius": 0.1, "surface": "smooth"})",
                                 1.0 / 30, fmt::format(kTracks, z));
    AssetStore meshes;
    const Error error =
        error_of([&] { plan_frames(scene, first_frames(6000), meshes, roomy_device()); });
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_THAT(error.what(), testing::EndsWith("(at frame 5001)"));
}

TEST_F(FramePlans, TellHowManyFramesAreDone) {
    const Scene scene =
        scene_of(R"({"shape": "sphere", "radius": 0.1, "surface": "smooth"})", 1.0 / 50, kGrowth);
    DeviceInfo device;
    device.memory = device.max_allocation = 8'000'000'000;
    AssetStore meshes;
    std::vector<size_t> done;
    plan_frames(scene, std::vector<int>{1, 2, 3}, meshes, device,
                [&](size_t frames) { done.push_back(frames); });
    EXPECT_EQ(done, (std::vector<size_t>{0, 1, 2}));
}

// The needs of solids in their own spaces are found once, unless their voxels or shapes differ.
TEST(SolidExtents, AreFoundOnceForEachModelAndEdge) {
    Model ball, box;
    ball.surface = Surface::smooth;
    box.surface = Surface::cubes;
    SolidExtents extents;
    int counted = 0;
    const auto of = [&](const Model& model, double edge) {
        return extents.of(model, edge, [&] { return SurfaceExtent{double(++counted), 0}; }).voxels;
    };
    EXPECT_EQ(of(ball, 0.5), 1);
    EXPECT_EQ(of(box, 0.5), 2);
    EXPECT_EQ(of(ball, 0.25), 3);
    EXPECT_EQ(of(Model(ball), 0.5), 1);
    EXPECT_EQ(of(box, 0.5), 2);
    EXPECT_EQ(counted, 3);
}

/// The plan of the frame of 1 to 3 that needs most memory, on a device with room for any.
FramePlan largest_of_three(const Scene& scene) {
    DeviceInfo device;
    device.memory = device.max_allocation = 8'000'000'000;
    AssetStore meshes;
    return plan_frames(scene, std::vector<int>{1, 2, 3}, meshes, device);
}

TEST_F(FramePlans, ALightThatIsSwitchedOnTakesItsShadowRays) {
    Scene scene = scene_of(R"({"shape": "sphere", "radius": 0.1, "surface": "smooth"})", 1.0 / 50,
                           R"("animation": {"frames": 3, "tracks": [
    {"target": "lights.lamp.intensity", "interpolation": "step",
     "keys": [{"frame": 1, "value": 0}, {"frame": 3, "value": 9}]}]},
    "lights": [{"name": "lamp", "type": "point", "position": [0.5, 2, 0.5], "intensity": 1}],)");
    scene.render.size = {320, 240};
    const FramePlan maximum = largest_of_three(scene);
    EXPECT_EQ(maximum.frame, 3);
    EXPECT_GT(maximum.plan.image_bytes, plan_of(scene_at(scene, 1)).image_bytes);
}

TEST_F(FramePlans, AnObserverWhoMovesAndALightThatDimsChangeNothing) {
    Scene scene = scene_of(R"({"shape": "sphere", "radius": 0.1, "surface": "smooth"})", 1.0 / 50,
                           R"("animation": {"frames": 40, "tracks": [
    {"target": "observer.position", "keys": [{"frame": 1, "value": [0.5, 0.5, 3]},
                                             {"frame": 40, "value": [0.5, 0.4, 0.42]}]},
    {"target": "lights.lamp.intensity", "keys": [{"frame": 1, "value": 0}, {"frame": 2, "value": 1},
                                                 {"frame": 40, "value": 9}]}]},
    "lights": [{"name": "lamp", "type": "point", "position": [0.5, 2, 0.5], "intensity": 1}],)");
    DeviceInfo device;
    device.memory = device.max_allocation = 8'000'000'000;
    for (Material& material : scene.materials) material.opacity = 0.5;  // the last view is inside
    std::vector<int> frames(40);
    std::iota(frames.begin(), frames.end(), 1);
    AssetStore meshes;
    const FramePlan maximum = plan_frames(scene, frames, meshes, device);
    EXPECT_EQ(maximum.plans, 2);  // without light, and with it
    for (const int frame : {2, 20, 40})
        EXPECT_EQ(maximum.plan.peak_bytes(), plan_of(scene_at(scene, frame)).peak_bytes()) << frame;
}

TEST_F(FramePlans, WithoutColorAnObserverWhoComesInsideOfAnObjectCounts) {
    Scene scene = scene_of(R"({"shape": "sphere", "radius": 0.1, "surface": "smooth"})", 1.0 / 50,
                           R"("animation": {"frames": 3, "tracks": [
    {"target": "observer.position", "keys": [{"frame": 1, "value": [0.5, 0.5, 3]},
                                             {"frame": 3, "value": [0.5, 0.4, 0.42]}]}]},)");
    scene.render.size = {320, 240};
    scene.render.channels.color = false;
    for (Material& material : scene.materials) material.opacity = 0.5;
    const FramePlan maximum = largest_of_three(scene);
    EXPECT_EQ(maximum.frame, 3);
    EXPECT_GT(maximum.plan.image_bytes, plan_of(scene_at(scene, 1)).image_bytes);
}

TEST_F(FramePlans, AGroupThatAMeshDoesNotHaveIsNamedBeforeAnyFrameIsRendered) {
    put_bytes(folder / "plate.obj",
              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nusemtl near\nf 1 2 3\nusemtl far\nf 2 4 3\n");
    constexpr const char* kText = R"({{"voxelume": 1,
        "world": {{"voxel_size": 0.1, "bounds": {{"min": [0,0,0], "max": [1,0.9,0.8]}}}},
        "materials": {{"red": {{}}}}, "models": {{"plate": {{"mesh": "plate.obj", "surface": "smooth"}}}},
        "objects": [{{"name": "plate", "model": "plate", "placement": "{}",
                     "materials": {{"{}": "red"}}}}],
        "observer": {{"position": [0.5,0.4,3], "look_at": [0.5,0.4,0.4],
                     "display": {{"shape": "pyramid", "angle": 40}}}},
        "animation": {{"frames": 4, "tracks": [{{"target": "objects.plate.visible",
            "keys": [{{"frame": 1, "value": false}}, {{"frame": 3, "value": true}}]}}]}}}})";
    DeviceInfo device;
    device.memory = device.max_allocation = 8'000'000'000;
    const std::vector<int> frames = {1, 2, 3, 4};
    for (const char* placement : {"world", "instance"}) {
        const auto scene = [&](const char* group) {
            return parse_scene(fmt::format(kText, placement, group), folder / "scene.json", {});
        };
        AssetStore meshes;
        EXPECT_NO_THROW(check_frames(scene("far"), frames, meshes, device));
        const Scene wrong = scene("fare");
        // The object is seen from frame 3 on, and changes the plan no more, of however many frames.
        for (const Error& error :
             {error_of([&] { check_frames(wrong, frames, meshes, device); }),
              error_of([&] { plan_frames(wrong, frames, meshes, device); }),
              error_of([&] { plan_frames(wrong, first_frames(3000), meshes, device); })}) {
            EXPECT_EQ(error.kind(), ErrorKind::scene);
            EXPECT_THAT(error.what(), HasSubstr("the mesh has no group of faces named \"fare\"; "
                                                "did you mean \"far\"? (at frame 3)"));
        }
    }
}

}  // namespace voxelume
