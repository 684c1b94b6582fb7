// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_file/document/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/base/error.hpp"
#include "runtime/scene/fitted.hpp"
#include "runtime/scene/parts/bounds.hpp"
#include "runtime/scene/scene_motion.hpp"

namespace voxelume {
namespace {

void refuse_motion(const Scene& scene) {
    if (!scene.motion) return;
    for (const MovingPart& part : scene.motion->parts)
        if (part.part == ScenePart::observer)
            throw Error(ErrorKind::usage,
                        "{}: the observer moves by a track, so there are no views around the "
                        "scene; leave the track out",
                        scene.observer.where);
}

/// The member with a key, added if it is missing.
JsonValue& member(JsonValue& object, const std::string& key) {
    const auto found = std::ranges::find(object.members, key, &JsonMember::key);
    if (found != object.members.end()) return found->value;
    JsonMember& added = object.members.emplace_back();
    added.key = key;
    added.value.type = JsonType::object;
    return added.value;
}

void put_vector(JsonValue& object, const std::string& key, const glm::dvec3& vector) {
    JsonValue& list = member(object, key);
    list.type = JsonType::array;
    list.items.assign(3, {});
    for (int i = 0; i < 3; ++i) {
        list.items[size_t(i)].type = JsonType::number;
        list.items[size_t(i)].at = list.at;
        list.items[size_t(i)].number = vector[i];
    }
}

/// The point that the document's observer looks at.
glm::dvec3 middle_of(const JsonValue& observer, const Scene& scene) {
    const auto found = std::ranges::find(observer.members, "look_at", &JsonMember::key);
    if (found != observer.members.end()) {
        const std::vector<JsonValue>& items = found->value.items;
        return {items[0].number, items[1].number, items[2].number};
    }
    if (scene.fitted.observer) return scene.fitted.look_at;
    const Bounds world = lattice_bounds(scene.world);
    return (world.min + world.max) / 2.0;
}

void put_number(JsonValue& object, const std::string& key, double number) {
    JsonValue& value = member(object, key);
    value.type = JsonType::number;
    value.number = number;
}

/// Adds the display of a fitted observer, as `voxelume check` prints it.
void add_fitted_display(JsonValue& observer, double near) {
    JsonValue& display = member(observer, "display");
    JsonValue& shape = member(display, "shape");
    shape.type = JsonType::string;
    shape.text = "pyramid";
    put_number(display, "angle", 40);
    put_number(display, "near", near);
}

}  // namespace

JsonValue orbited(const JsonValue& document, const Scene& scene, double degrees) {
    refuse_motion(scene);
    JsonValue changed = document;
    JsonValue& observer = member(changed, "observer");
    const glm::dvec3 middle = middle_of(observer, scene);
    const double angle = glm::radians(degrees), s = std::sin(angle), c = std::cos(angle);
    const glm::dmat3 turn(c, 0, -s, 0, 1, 0, s, 0, c);
    const glm::dmat3 axes = turn * scene.observer.world_from_observer;
    const glm::dvec3 position = middle + turn * (scene.observer.position - middle);
    if (scene.fitted.observer)
        add_fitted_display(observer, fitted_near(scene.world, position, axes[2]));
    std::erase_if(observer.members, [](const JsonMember& m) { return m.key == "turn"; });
    put_vector(observer, "position", position);
    put_vector(observer, "look_at", position + axes[2]);
    put_vector(observer, "up", axes[1]);
    return changed;
}

}  // namespace voxelume
