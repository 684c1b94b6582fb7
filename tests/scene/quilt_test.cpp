// SPDX-License-Identifier: Apache-2.0
// The views of a light field: what lies in the window has one place in all of them.
#include "runtime/scene/quilt.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/base/error.hpp"
#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

Scene seen_by(const std::string& observer) {
    return parse_scene(R"({"voxelume": 1, "models": {"m": {"shape": "sphere", "radius": 1}},
                           "objects": [{"model": "m"}], "observer": {)" +
                           observer + R"(}, "render": {"size": [210, 280]}})",
                       "q.json", {});
}

const std::string kAside = R"("position": [3, 2, 5], "look_at": [0.5, 0, 0.25],
                              "display": {"shape": "pyramid", "angle": 30})";

/// The position of a point in a view's image, in pixels from the image's top left.
glm::dvec2 pixel_of(const Scene& view, const glm::dvec3& point) {
    const Observer& observer = view.observer;
    const glm::dvec3 p = glm::transpose(observer.world_from_observer) * (point - observer.position);
    const glm::dvec2 half = glm::tan(observer.display.half_angles);
    const glm::dvec2 frame(frame_size(view.render));
    return (glm::dvec2(-p.x, -p.y) / p.z / half + 1.0) / 2.0 * frame -
           glm::dvec2(view.render.crop.first);
}

TEST(Quilt, TheWindowHasOnePlaceInAllViews) {
    const Scene scene = seen_by(kAside);
    const Observer& observer = scene.observer;
    for (const double focus : {0.0, 2.5}) {
        const double distance = focus > 0 ? focus : glm::length(glm::dvec3(2.5, 2, 4.75));
        const ViewRow row{7, 50, focus};
        for (int number = 0; number < row.views; ++number) {
            const Scene view = view_of_row(scene, row, number);
            EXPECT_EQ(view.render.size, scene.render.size);
            for (const glm::dvec2& at :
                 {glm::dvec2(0), glm::dvec2(0.3, -0.4), glm::dvec2(-0.7, 0.2)}) {
                const glm::dvec3 point =
                    observer.position +
                    observer.world_from_observer * glm::dvec3(at * 0.2 * distance, distance);
                const glm::dvec2 expected = pixel_of(scene, point), shown = pixel_of(view, point);
                EXPECT_NEAR(shown.x, expected.x, 1e-9) << number;
                EXPECT_NEAR(shown.y, expected.y, 1e-9) << number;
            }
            // Points behind the window move with the observer, who moves to the right.
            const glm::dvec3 behind =
                observer.position + observer.world_from_observer[2] * 2.0 * distance;
            const double pixel = 2 * std::tan(observer.display.half_angles.x) / 210;
            const double aside = (number / 3.0 - 1) * std::tan(glm::radians(25.0));
            EXPECT_NEAR(pixel_of(view, behind).x - 105, aside / pixel / 2, 0.26) << number;
            const glm::dvec3 place =
                observer.position - observer.world_from_observer[0] * (aside * distance);
            EXPECT_LE(glm::length(view.observer.position - place), 0.5001 * pixel * distance);
            EXPECT_EQ(view.observer.world_from_observer, observer.world_from_observer);
        }
    }
    EXPECT_EQ(view_of_row(scene, {7, 50, 0}, 3).observer.position, observer.position);
    EXPECT_EQ(view_of_row(scene, {1, 50, 0}, 0).observer.position, observer.position);
}

TEST(Quilt, EyesAreAsFarApartAsAskedForAndSeeTheWindowInOnePlaceToHalfAPixel) {
    const Scene scene = seen_by(kAside);
    const Observer& observer = scene.observer;
    for (const double focus : {0.0, 2.5, 40.0}) {
        const double distance = focus > 0 ? focus : glm::length(glm::dvec3(2.5, 2, 4.75));
        const ViewRow eyes{2, 40, focus, 0.064};
        const glm::dvec3 point =
            observer.position + observer.world_from_observer * glm::dvec3(0.1, -0.05, 1) * distance;
        for (int number = 0; number < 2; ++number) {
            const Scene view = view_of_row(scene, eyes, number);
            const glm::dvec3 place =
                observer.position - observer.world_from_observer[0] * (0.064 * (number - 0.5));
            EXPECT_LE(glm::length(view.observer.position - place), 1e-12);
            EXPECT_NEAR(pixel_of(view, point).x, pixel_of(scene, point).x, 0.5 + 1e-9);
            EXPECT_NEAR(pixel_of(view, point).y, pixel_of(scene, point).y, 1e-9);
        }
    }
}

TEST(Quilt, OtherObserversAreRefused) {
    const auto refusal = [](const std::string& observer, const ViewRow& row) {
        try {
            view_of_row(seen_by(observer), row, 0);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(refusal(R"("position": [0, 0, 5], "projection": "panoramic")", {}),
                HasSubstr("is a pyramid"));
    EXPECT_THAT(
        refusal(R"("position": [0, 0, 5], "display": {"shape": "pyramid", "angle": 30})", {}),
        HasSubstr("lies behind the observer"));
    EXPECT_THAT(refusal(R"("position": [0, 0, 5], "look_at": [0, 0, 0],
                           "display": {"shape": "pyramid", "angle": 0.01})",
                        {2, 120, 0}),
                HasSubstr("65536 are the most"));
}

}  // namespace
}  // namespace voxelume
