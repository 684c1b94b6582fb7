// SPDX-License-Identifier: Apache-2.0
// Quilts and stereo pairs that callers get.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/api/api_fixture.hpp"

namespace voxelume::v1 {
namespace {

class ApiQuilt : public ApiTest {
  protected:
    /// A ball before a wall, in 12 x 8 pixels.
    static Scene ball() {
        SceneDescription scene;
        scene.name = "ball";
        scene.models = {{.name = "ball", .source = Sphere{0.3}},
                        {.name = "wall", .source = Box{{4, 4, 0.2}}}};
        scene.objects = {{.model = "ball"}, {.model = "wall", .position = {0, 0, 1}}};
        scene.observer = {.position = {0, 0, -3},
                          .look_at = Vec3{0, 0, 0},
                          .display = {.shape = PyramidDisplay{.near = 1, .far = 6}}};
        scene.render.size = {12, 8};
        return Scene::build(scene);
    }

    static std::string refusal(const std::function<void()>& call) {
        try {
            call();
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::usage);
            return error.what();
        }
        return {};
    }

    RenderOptions quick{.cache = {.enabled = false}};
};

TEST_F(ApiQuilt, OfViewsIsWhatIsRenderedAtOnce) {
    const Quilt pair{.columns = 2, .rows = 1, .focus = 3, .separation = 0.5};
    const std::vector<Image> views = render_views(ball(), *device, pair, 1, quick);
    ASSERT_EQ(views.size(), 2u);
    const Image joined = join_views(views, pair),
                at_once = render_quilt(ball(), *device, pair, 1, quick);
    ASSERT_EQ(joined.width(), 24);
    ASSERT_EQ(joined.height(), 8);
    EXPECT_TRUE(std::ranges::equal(joined.plane("G"), at_once.plane("G")));
    EXPECT_EQ(joined.encode(".exr"), at_once.encode(".exr"));
    for (size_t i = 0; i < joined.plane("G").size(); ++i) {
        const size_t x = i % 24, y = i / 24;
        EXPECT_EQ(joined.plane("G")[i], views[x / 12].plane("G")[12 * y + x % 12]);
    }
    EXPECT_NE(views[0].encode(".exr"), views[1].encode(".exr"));
}

TEST_F(ApiQuilt, StatisticsOfLaterRunsAreAdded) {
    Statistics sum, one;
    one.frames.resize(2);
    one.rays.sight_rays = 5;
    one.rays.noise = 0.3;
    one.voxels = 7;
    one.warnings = {{.where = "here", .text = "wrong"}};
    one.launches["a"] = 1;
    add_statistics(one, sum);
    one.frames.resize(1);
    one.rays.noise = 0.6;
    one.voxels = 6;
    one.launches["a"] = 2;
    add_statistics(one, sum);
    EXPECT_EQ(sum.frames.size(), 3u);
    EXPECT_EQ(sum.rays.sight_rays, 10u);
    EXPECT_DOUBLE_EQ(*sum.rays.noise, std::sqrt((2 * 0.09 + 0.36) / 3));
    EXPECT_EQ(sum.voxels, 7u);
    EXPECT_EQ(sum.warnings.size(), 1u);
    EXPECT_EQ(sum.launches["a"], 2u) << "counters are since the device was opened";
}

TEST_F(ApiQuilt, RefusesOtherViewsAndSeparations) {
    using testing::HasSubstr;
    const Quilt pair{.columns = 2, .rows = 1};
    std::vector<Image> views = render_views(ball(), *device, pair, 1, quick);
    EXPECT_THAT(refusal([&] { join_views({}, pair); }), HasSubstr("2 images"));
    EXPECT_THAT(refusal([&] { join_views(views, {.columns = 3, .rows = 1}); }),
                HasSubstr("3 images"));
    RenderOptions other = quick;
    other.channels = {.color = false, .depth = true};
    views[1] = render_image(ball(), *device, 1, other);
    EXPECT_THAT(refusal([&] { join_views(views, pair); }), HasSubstr("the same channels"));
    for (const double separation : {-0.1, 1e10, double(NAN)})
        EXPECT_THAT(
            refusal([&] { render_views(ball(), *device, {.separation = separation}, 1, quick); }),
            HasSubstr("separation"));
}

}  // namespace
}  // namespace voxelume::v1
