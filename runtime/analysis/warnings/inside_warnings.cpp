// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/warnings/inside_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <optional>

#include "runtime/analysis/warnings/warned_object.hpp"
#include "runtime/geometry/solid/solid_bounds.hpp"
#include "runtime/geometry/solid/solid_inside.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

/// The share of all directions that a mesh covers around a point inside of it. A shade that is open
/// at both ends covers less.
constexpr double kEnclosed = 0.97;

bool is_in_box(const Bounds& box, const glm::dvec3& p) {
    return glm::all(glm::lessThan(box.min, p)) && glm::all(glm::lessThan(p, box.max));
}

/// True if an object encloses a point of the world.
bool encloses(const Scene& scene, const Object& object, const glm::dvec3& point,
              AssetStore& meshes) {
    const Model& model = scene.models[size_t(object.model)];
    const glm::dvec3 p(glm::inverse(object.world_from_object) * glm::dvec4(point, 1));
    if (model.solid) return is_inside(*model.solid, p);
    if (model.mesh.empty() || !is_in_box(meshes.summary_of(model)->surface, p)) return false;
    if (std::ranges::any_of(model.cuts, [&](const Solid& cut) { return is_inside(cut, p); }))
        return false;
    return std::abs(meshes.winding_of(model, p)) > kEnclosed;
}

/// The box of a model in its own space; nothing for one without end or of voxels.
std::optional<Bounds> own_box(const Model& model, AssetStore& meshes) {
    if (!model.solid) {
        const MeshSummary* mesh = meshes.summary_of(model);
        return mesh ? std::optional(mesh->surface) : std::nullopt;
    }
    if (is_infinite(*model.solid)) return std::nullopt;
    const SolidBounds own = bounds(*model.solid, glm::dmat4(1));
    return Bounds{own.min, own.max};
}

/// True if an object wholly encloses the other, as a room encloses its furniture: the middle and
/// the corners of its box are inside. If the middle alone is, the other is stuck in a wall.
bool encloses(const Scene& scene, const Object& object, const Object& other, AssetStore& meshes) {
    const auto box = own_box(scene.models[size_t(other.model)], meshes);
    const auto has = [&](const glm::dvec3& p) {
        const glm::dvec3 point(other.world_from_object * glm::dvec4(p, 1));
        return encloses(scene, object, point, meshes);
    };
    if (!box || !has((box->min + box->max) / 2.0)) return false;
    for (int i = 0; i < 8; ++i)
        if (!has(corner(*box, i))) return false;
    return true;
}

/// The point at which the sight ray through the image's middle begins; empty if rays begin on a
/// sphere around the observer, or anywhere.
std::optional<glm::dvec3> start_of_sight(const Observer& observer) {
    const Display& display = observer.display;
    const bool is_sphere = !shape_row(display).depth_is_along_z && display.near > 0;
    if (display.layout == VolumeLayout::lattice || is_sphere) return std::nullopt;
    return observer.position + display.near * observer.world_from_observer[2];
}

bool is_body(const Scene& scene, const Object& object) {
    return object.visible && !transmits(scene, object);
}

bool holds_a_light(const Scene& scene, const Object& object, AssetStore& meshes) {
    return std::ranges::any_of(scene.lights, [&](const Light& light) {
        return shines(light) && type_of(light).has_position &&
               encloses(scene, object, light.position, meshes);
    });
}

bool holds_an_object(const Scene& scene, const Object& object, AssetStore& meshes) {
    return std::ranges::any_of(scene.objects, [&](const Object& other) {
        return &other != &object && other.visible && encloses(scene, object, other, meshes);
    });
}

}  // namespace

void add_inside_warnings(const Scene& scene, AssetStore& meshes, std::vector<Warning>& warnings) {
    const std::optional<glm::dvec3> eye = start_of_sight(scene.observer);
    // A mesh in the wrong unit holds all of the scene.
    const auto has_wrong_size = [&](const Object& object) {
        return std::ranges::any_of(warnings, [&](const Warning& warning) {
            return warning.kind == WarningKind::unlikely_unit && warning.where == object.where;
        });
    };
    for (const Object& object : scene.objects) {
        if (!is_body(scene, object) || has_wrong_size(object)) continue;
        const bool holds_eye = eye && encloses(scene, object, *eye, meshes);
        if (holds_eye && !holds_a_light(scene, object, meshes) &&
            !holds_an_object(scene, object, meshes))
            add_once({WarningKind::observer_in_object, scene.observer.where,
                      fmt::format("the observer is inside {}, which is opaque, so nothing else is "
                                  "seen: move one of them",
                                  title_of(object))},
                     warnings);
        if (holds_eye || !scene.render.shadows || !scene.render.channels.color) continue;
        for (const Light& light : scene.lights)
            if (shines(light) && type_of(light).has_position &&
                encloses(scene, object, light.position, meshes))
                add_once({WarningKind::light_inside_object, light.where,
                          fmt::format("the light is inside {}, which is opaque, so nothing else is "
                                      "lit by it: move one of them",
                                      title_of(object))},
                         warnings);
    }
}

}  // namespace voxelume
