// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/quilt.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

void check_observer(const Scene& scene) {
    const Observer& observer = scene.observer;
    if (observer.projection != Projection::display ||
        shape_row(observer.display).projection != SightProjection::perspective)
        throw Error(ErrorKind::usage,
                    "views of a light field need an observer whose display is a pyramid");
    if (!scene.render.crop.is_whole())
        throw Error(ErrorKind::usage, "a view of a light field can't be a part of an image");
}

/// The distance of the window along Z_E.
double focus_of(const Scene& scene, const ViewRow& row) {
    if (row.focus > 0) return row.focus;
    const Observer& observer = scene.observer;
    if (observer.focus > 0) return observer.focus;
    const Bounds& box = scene.world.bounds;
    const double focus =
        glm::dot((box.min + box.max) / 2.0 - observer.position, observer.world_from_observer[2]);
    if (focus > 0) return focus;
    throw Error(ErrorKind::usage,
                "the middle of the world lies behind the observer: give the distance at which what "
                "is seen lies in the screen");
}

}  // namespace

Scene view_of_row(const Scene& scene, const ViewRow& row, int number) {
    check_observer(scene);
    const double focus = focus_of(scene, row);
    Scene view = scene;
    view.motion.reset();
    view.fitted.observer = false;
    Observer& observer = view.observer;
    glm::dvec2& half = observer.display.half_angles;
    const glm::ivec2 size = scene.render.size;
    const double along = row.views > 1 ? 2.0 * number / (row.views - 1) - 1 : 0;
    const double pixel = 2 * std::tan(half.x) / size.x;  // width of a pixel at distance 1
    const double aside = along * (row.separation > 0 ? row.separation / 2 / focus
                                                     : std::tan(glm::radians(row.cone / 2)));
    const double pixels = std::round(aside / pixel);
    if (size.x + 2 * std::abs(pixels) > kMaxImageSide)
        throw Error(
            ErrorKind::limit,
            "views of {} pixels from places so far apart are parts of images of {:.0f}, and "
            "{} are the most; make the cone, the distance of the eyes or the views smaller",
            size.x, size.x + 2 * std::abs(pixels), kMaxImageSide);
    // The right-hand side of images is -X_E.
    const double moved = row.separation > 0 ? aside : pixels * pixel;
    observer.position -= observer.world_from_observer[0] * (moved * focus);
    const int wider = int(std::abs(pixels));
    half.x = std::atan(std::tan(half.x) * (size.x + 2.0 * wider) / size.x);
    observer.display.square_pixels = false;
    view.render.size = {size.x + 2 * wider, size.y};
    // A view's tiles are its own: nobody renders the wider image.
    view.render.noise = {};
    crop(view, {pixels > 0 ? 0 : 2 * wider, 0}, size);
    view.render.noise = scene.render.noise;
    return view;
}

}  // namespace voxelume
