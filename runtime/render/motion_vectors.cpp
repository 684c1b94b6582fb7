// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/motion_vectors.hpp"

#include <cmath>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "runtime/base/error.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/shutter.hpp"

namespace voxelume {
namespace {

/// The maps from each object's points now to their later positions.
std::vector<glm::dmat4> movements(const Scene& now, const Scene& then) {
    std::vector<glm::dmat4> maps;
    maps.reserve(now.objects.size());
    for (size_t i = 0; i < now.objects.size(); ++i)
        maps.push_back(then.objects[i].world_from_object *
                       glm::inverse(now.objects[i].world_from_object));
    return maps;
}

/// The number of columns after which a picture of all directions repeats; 0 for other pictures.
double columns_around(const Scene& scene) {
    const DisplayShapeRow& shape = shape_row(scene.observer.display);
    const bool goes_around = shape.projection == SightProjection::angular && !shape.image_is_round;
    return goes_around ? frame_size(scene.render).x : 0;
}

/// Adds the two planes of one direction of time.
void add_movement(const Scene& now, const Scene& then, const std::string& name, Image& image) {
    const std::vector<glm::dmat4> maps = movements(now, then);
    const double around = columns_around(now);
    const Plane<uint32_t>& objects = image.id_planes.at("objectId");
    const Plane<float>&x = image.planes.at("P.X"), &y = image.planes.at("P.Y"),
          &z = image.planes.at("P.Z");
    std::vector<float> right(objects.size(), 0.0f), up = right;
    for (size_t i = 0; i < objects.size(); ++i) {
        if (objects[i] == 0) continue;
        const glm::dvec3 point(x[i], y[i], z[i]);
        const glm::dvec3 moved(maps[objects[i] - 1] * glm::dvec4(point, 1));
        const auto from = position_in_picture(now, point), to = position_in_picture(then, moved);
        if (!from || !to) continue;
        const double moved_right = to->x - from->x;
        // The shorter way may cross the picture's side.
        right[i] = float(around > 0 ? std::remainder(moved_right, around) : moved_right);
        up[i] = float(from->y - to->y);
    }
    image.planes[name + ".u"] = std::move(right);
    image.planes[name + ".v"] = std::move(up);
}

}  // namespace

std::optional<glm::dvec2> position_in_picture(const Scene& scene, const glm::dvec3& point) {
    const Observer& observer = scene.observer;
    const glm::dvec3 p = glm::transpose(observer.world_from_observer) * (point - observer.position);
    const std::optional<glm::dvec2> on_display =
        shape_row(observer.display).ray_through(observer.display, p);
    if (!on_display) return {};
    return (*on_display + 1.0) / 2.0 * glm::dvec2(frame_size(scene.render));
}

void add_motion(const Scene& scene, int frame, Image& image) {
    const Scene now = scene_at(scene, frame);
    add_movement(now, scene_at(scene, frame + 1), "forward", image);
    add_movement(now, scene_at(scene, frame - 1), "backward", image);
}

void check_motion(const Scene& scene) {
    if (!has_moments(scene)) return;
    throw Error(ErrorKind::usage,
                "channels motion are of images that show one moment: leave the observer's shutter "
                "out, or render them in a run of their own with one sample");
}

}  // namespace voxelume
