// SPDX-License-Identifier: Apache-2.0
// Observers whose projection makes their display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>

#include "runtime/base/error.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A scene of 640 x 480 pixels whose observer stands 7 m from the world's farthest corner.
Scene projected(const std::string& members, const std::string& more = "") {
    return parse_scene(
        R"({"voxelume": 1, "world": {"voxel_size": 0.5, "bounds": {"min": [0, 0, 0], "max": [2, 3, 6]}},
            "observer": {"position": [0, 0, 0], )" +
            members + "}" + more + "}",
        "room.json", {});
}

std::string projection_refused(const std::string& members) {
    try {
        projected(members);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(SceneProjection, OrthographicIsABoxOfSquarePixelsToTheWorldsEnd) {
    const Display wide = projected(R"("projection": "orthographic", "width": 8)").observer.display;
    EXPECT_EQ(wide.shape, DisplayShape::box);
    EXPECT_EQ(wide.half_size, glm::dvec2(4, 3));
    EXPECT_EQ(wide.near, 0);
    EXPECT_DOUBLE_EQ(wide.far, 7);
    EXPECT_EQ(wide.voxels, glm::ivec3(640, 480, 256));
    const Display high = projected(R"("projection": "orthographic", "height": 8)").observer.display;
    EXPECT_DOUBLE_EQ(high.half_size.x, 16.0 / 3);
    EXPECT_EQ(high.half_size.y, 4);
}

TEST(SceneProjection, KeepsPixelsSquareInImagesOfOtherSizes) {
    Scene wide = projected(R"("projection": "orthographic", "width": 8)");
    resize(wide, {100, 300});
    EXPECT_EQ(wide.observer.display.half_size, glm::dvec2(4, 12));
    Scene high = projected(R"("projection": "orthographic", "height": 8)");
    resize(high, {100, 400});
    EXPECT_EQ(high.observer.display.half_size, glm::dvec2(1, 4));
    Scene box = projected(R"("display": {"shape": "box", "size": [2, 4, 6]})");
    resize(box, {100, 300});
    EXPECT_EQ(box.observer.display.half_size, glm::dvec2(1, 2)) << "that of a display stays";
}

/// The width of what a pixel spans over its height.
double aspect_of(const Scene& scene) {
    const Display& display = scene.observer.display;
    const glm::dvec2 half =
        display.shape == DisplayShape::box ? display.half_size : glm::tan(display.half_angles);
    return half.x / scene.render.size.x / (half.y / scene.render.size.y);
}

TEST(SceneProjection, PixelsHaveTheAspectThatIsAskedFor) {
    const std::string wide = R"(, "render": {"size": [300, 400], "pixel_aspect": 2})";
    for (const char* members : {R"("display": {"shape": "pyramid", "angle": 40})",
                                R"("projection": "orthographic", "width": 8)",
                                R"("projection": "orthographic", "height": 8)"}) {
        Scene scene = projected(members, wide);
        EXPECT_NEAR(aspect_of(scene), 2, 1e-12) << members;
        resize(scene, {123, 45});
        EXPECT_NEAR(aspect_of(scene), 2, 1e-12) << members;
    }
    Scene moving = projected(R"("display": {"shape": "pyramid", "angle": 40})",
                             wide + R"(, "animation": {"frames": 2, "tracks": [
        {"target": "observer.display.angle", "keys": [{"frame": 1, "value": 40},
                                                      {"frame": 2, "value": 60}]}]})");
    EXPECT_NEAR(aspect_of(scene_at(moving, 2)), 2, 1e-12);
    Scene fitted =
        parse_scene(R"({"voxelume": 1, "models": {"a": {"shape": "box", "size": [1, 2, 3]}},
        "objects": [{"model": "a"}], "render": {"size": [300, 400], "pixel_aspect": 0.5}})",
                    "room.json", {});
    EXPECT_NEAR(aspect_of(fitted), 0.5, 1e-12);
    // Both angles of a display say what a pixel spans.
    EXPECT_NEAR(
        aspect_of(projected(R"("display": {"shape": "pyramid", "angles": [90, 90]})", wide)),
        400.0 / 300, 1e-12);
}

TEST(SceneProjection, PanoramicIsABallToTheWorldsEnd) {
    const Display ball = projected(R"("projection": "panoramic")").observer.display;
    EXPECT_EQ(ball.shape, DisplayShape::ball);
    EXPECT_DOUBLE_EQ(ball.far, 7);
    EXPECT_EQ(ball.voxels, glm::ivec3(640, 480, 256));
}

TEST(SceneProjection, PerspectiveIsThatOfAPyramid) {
    EXPECT_EQ(projected(R"("projection": "perspective", "display": {"shape": "pyramid"})"),
              projected(R"(              "display": {"shape": "pyramid"}             )"));
}

TEST(SceneProjection, MovesWithTracks) {
    const Scene scene = projected(R"("projection": "orthographic", "height": 8)",
                                  R"(, "animation": {"frames": 3, "tracks": [
        {"target": "observer.height", "keys": [{"frame": 1, "value": 8}, {"frame": 3, "value": 4}]},
        {"target": "observer.position", "keys": [{"frame": 3, "value": [0, 0, 0]},
                                                 {"frame": 5, "value": [0, 0, -18]}]}]})");
    EXPECT_EQ(scene_at(scene, 2).observer.display.half_size, glm::dvec2(4, 3));
    const Display last = scene_at(scene, 5).observer.display;
    EXPECT_EQ(last.half_size.y, 2);
    EXPECT_DOUBLE_EQ(last.far, std::sqrt(4.0 + 9.0 + 24.0 * 24.0));
    EXPECT_EQ(last.voxels, glm::ivec3(640, 480, 256));
}

TEST(SceneProjection, IsRefusedWhereItContradictsTheDisplay) {
    EXPECT_THAT(projection_refused(
                    R"("projection": "panoramic", "display": {"shape": "ball", "radius": 1})"),
                AllOf(HasSubstr("room.json:2:"), HasSubstr("observer.display"),
                      HasSubstr("\"panoramic\" makes the display; leave one of them out")));
    EXPECT_THAT(projection_refused(R"("projection": "perspective")"), HasSubstr("display"));
    EXPECT_THAT(projection_refused(R"("look_at": [1, 2, 3])"), HasSubstr("display"));
    EXPECT_THAT(projection_refused(
                    R"("projection": "perspective", "display": {"shape": "ball", "radius": 1})"),
                HasSubstr("\"perspective\" needs a display of the shape \"pyramid\""));
    EXPECT_THAT(projection_refused(R"("projection": "cylindrical")"), HasSubstr("\"panoramic\""));
}

TEST(SceneProjection, IsRefusedWithoutItsMeasureOrWithThatOfAnother) {
    EXPECT_THAT(projection_refused(R"("projection": "orthographic")"),
                HasSubstr("\"width\" or \"height\""));
    EXPECT_THAT(projection_refused(R"("projection": "orthographic", "width": 1, "height": 2)"),
                HasSubstr("leave one of them out"));
    EXPECT_THAT(projection_refused(R"("projection": "orthographic", "width": 0)"),
                HasSubstr("observer.width"));
    EXPECT_THAT(projection_refused(R"("projection": "panoramic", "width": 1)"),
                HasSubstr("needs \"projection\": \"orthographic\""));
    EXPECT_THAT(projection_refused(R"("height": 1, "display": {"shape": "pyramid"})"),
                HasSubstr("needs \"projection\": \"orthographic\""));
}

TEST(SceneProjection, ALensHasNoPolygonOfOneOrTwoCorners) {
    const std::string lens = R"("aperture": 0.1, "focus": 2, "display": {"shape": "pyramid"}, )";
    for (const char* blades : {"1", "2"})
        EXPECT_THAT(projection_refused(lens + R"("blades": )" + blades),
                    HasSubstr("observer.blades: a lens has 3 to 16 blades"));
    EXPECT_THAT(projection_refused(lens + R"("blades": 17)"), HasSubstr("observer.blades"));
    EXPECT_EQ(projected(lens + R"("blades": 6)").observer.blades, 6);
    EXPECT_EQ(projected(lens + R"("blades": 0)").observer.blades, 0);
}

TEST(SceneProjection, RefusesALens) {
    for (const char* projection : {R"("orthographic", "width": 2)", R"("panoramic")"})
        EXPECT_THAT(projection_refused(
                        std::string(R"("aperture": 0.1, "focus": 2, "projection": )") + projection),
                    HasSubstr("a lens needs a perspective"));
}

}  // namespace
}  // namespace voxelume
