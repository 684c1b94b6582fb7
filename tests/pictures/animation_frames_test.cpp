// SPDX-License-Identifier: Apache-2.0
// Every frame of the animations in scenes/, by default every sixth one, small and coarse: a run
// that retains what it can and overlaps its frames gives the bits of each frame rendered from
// nothing.
#include <gtest/gtest.h>

#include "runtime/analysis/scene_choices.hpp"
#include "runtime/batch/frame_schedule.hpp"
#include "runtime/render/volume_renderer.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/small_scene.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

/// A scene, and the frames, size and voxels of it that a test of many frames can afford.
struct Animation {
    const char* name;
    glm::ivec2 size;
    double voxels;  ///< along the world's longest axis
    bool is_volume = false;
};

class AnimationFrames : public testing::TestWithParam<Animation> {};
INSTANTIATE_TEST_SUITE_P(Scenes, AnimationFrames,
                         testing::Values(Animation{"turntable", {40, 28}, 24, true},
                                         Animation{"procession", {48, 32}, 48},
                                         Animation{"pendulum", {48, 36}, 48},
                                         Animation{"melt", {48, 36}, 40},
                                         Animation{"drill", {48, 36}, 40}),
                         [](const auto& animation) { return std::string(animation.param.name); });

/// By default, every other frame of the animation is rendered.
const double kStep = is_exhaustive() ? 1 : 2;

Scene scene_of_frame(const Scene& scene, size_t n) {
    return scene_at(scene, 1 + kStep * double(n));
}

/// All values in a volume.
struct ShownVolume {
    std::vector<uint64_t> indices;
    std::vector<glm::vec3> colors;
    std::vector<float> opacities, depths;
    std::vector<uint32_t> objects;
    friend bool operator==(const ShownVolume&, const ShownVolume&) = default;
};

ShownVolume shown(Volume volume) {
    return {std::move(volume.indices), std::move(volume.colors), std::move(volume.opacities),
            std::move(volume.depths), std::move(volume.objects)};
}

struct Frame {
    uint64_t image = 0;
    ShownVolume volume;
};

Frame frame_alone(const Scene& scene, bool is_volume) {
    RenderReport report;
    Frame frame{oracle::image_hash(render(shared_device(), scene, report)), {}};
    if (is_volume) frame.volume = shown(render_volume(shared_device(), scene, report));
    return frame;
}

std::vector<Frame> frames_in_a_run(const Scene& scene, bool is_volume) {
    std::vector<Frame> frames(size_t(scene.animation.frames / kStep));
    Renderer renderer(shared_device());
    const FrameSteps steps{[&](size_t n) { return scene_of_frame(scene, n); },
                           [&](const FrameInput& input) -> std::function<void()> {
                               Frame& frame = frames[input.frame];
                               RenderReport report;
                               if (is_volume)
                                   frame.volume = shown(render_volume(shared_device(), input.scene,
                                                                      input.world, report));
                               auto image = renderer.image(input.scene, input.world, report);
                               return [&frame, image] { frame.image = oracle::image_hash(*image); };
                           }};
    run_frames({shared_device()}, frames.size(), steps, {.overlap = true});
    return frames;
}

TEST_P(AnimationFrames, HaveTheBitsOfEachAlone) {
    Scene scene = small_scene(GetParam().name, GetParam().size, GetParam().voxels);
    AssetStore meshes;
    make_choices(scene, meshes);  // once for all frames
    if (GetParam().is_volume) scene.observer.display.voxels = {13, 9, 13};
    const std::vector<Frame> run = frames_in_a_run(scene, GetParam().is_volume);
    ASSERT_GE(run.size(), size_t(48 / kStep));
    size_t changes = 0;
    for (size_t n = 0; n < run.size(); ++n) {
        if (n > 0) changes += run[n].image != run[n - 1].image;
        if (!is_exhaustive() && n % 3 != 1) continue;
        const Frame alone = frame_alone(scene_of_frame(scene, n), GetParam().is_volume);
        EXPECT_EQ(run[n].image, alone.image) << n;
        EXPECT_TRUE(run[n].volume == alone.volume) << n;
    }
    EXPECT_GT(changes, run.size() / 2);
}

}  // namespace
}  // namespace voxelume
