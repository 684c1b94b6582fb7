// SPDX-License-Identifier: Apache-2.0
#include "runtime/batch/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <utility>

#include "runtime/analysis/object_boxes.hpp"
#include "runtime/analysis/warnings/warned_object.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/scene/parts/display_shape.hpp"
#include "runtime/scene/scene_animation.hpp"

namespace voxelume {
namespace {

/// The box around all visible objects in the world, metres; empty (min > max) without any. Objects
/// at the places `lost` are left out, since they became no voxels.
Bounds box_of_objects(Scene scene, AssetStore meshes, const std::vector<SourcePlace>& lost) {
    for (Object& object : scene.objects) {
        object.potentially_visible = true;
        if (std::ranges::find(lost, object.where) != lost.end()) object.visible = false;
    }
    const GridFrame world = world_frame(scene.world);
    Bounds all{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
    for (const VoxelBox& box : object_boxes(scene, meshes)) {
        if (is_empty(box)) continue;
        all.min = glm::min(all.min, world.origin + world.voxel_edge * box.low);
        all.max = glm::max(all.max, world.origin + world.voxel_edge * box.high);
    }
    return all;
}

/// The diagonal of the box around all visible objects as they are, without the voxels that show
/// them: metres.
double size_of_objects(const Scene& scene, AssetStore meshes) {
    Bounds all{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
    for (const Object& object : scene.objects) {
        if (!object.visible) continue;
        const PlacedModel model = placed(scene, object, meshes);
        if (model.is_empty) continue;
        all.min = glm::min(all.min, model.world.min);
        all.max = glm::max(all.max, model.world.max);
    }
    return all.min.x <= all.max.x ? glm::length(all.max - all.min) : INFINITY;
}

/// True if a point lies in the flat image, and `size` metres there are less than a pixel.
bool is_below_a_pixel(const Observer& observer, const glm::ivec2& image, const glm::dvec3& point,
                      double size) {
    const Display& display = observer.display;
    const glm::dvec3 way = point - observer.position;
    const glm::dvec3 seen = glm::transpose(observer.world_from_observer) * way;
    const DisplayShapeRow& shape = shape_row(display);
    const std::optional<glm::dvec2> uv = shape.ray_through(display, seen);
    if (!uv || (seen.z <= 0 && shape.looks_ahead(display))) return false;
    const double aside =
        shape.image_is_round ? glm::length(*uv) : std::max(std::abs(uv->x), std::abs(uv->y));
    const bool is_parallel = shape.projection == SightProjection::parallel;
    const double depth = shape.depth_is_along_z ? seen.z : glm::length(way);
    const glm::dvec2 pixel =
        2.0 * (is_parallel ? 1 : depth) * shape.half_extent(display) / glm::dvec2(image);
    return aside <= 1 && size < std::max(pixel.x, pixel.y);
}

/// Advice for an observer who sees nothing. The box `objects` isn't empty, and the objects are
/// `own_size` metres large.
std::string view_advice(const Observer& observer, const glm::ivec2& image, const Bounds& objects,
                        double own_size) {
    // To a hundredth or thousandth of the objects' size, as a person would write it; -0 is 0.
    const double size = glm::length(objects.max - objects.min);
    const double step = std::pow(10.0, std::floor(std::log10(std::max(size, 1e-9))) - 3);
    const glm::dvec3 middle =
        glm::round((objects.min + objects.max) / (2 * step)) * step + glm::dvec3(0);
    const double nearest =
        glm::length(glm::clamp(observer.position, objects.min, objects.max) - observer.position);
    double farthest = 0;
    for (int i = 0; i < 8; ++i)
        farthest = std::max(farthest, glm::length(corner(objects, i) - observer.position));
    if (observer.display.far < nearest)
        return fmt::format(
            "the display ends at {:.3g} m, and the nearest object may be at "
            "{:.3g} m: change \"far\"",
            observer.display.far, nearest);
    if (observer.display.near > farthest)
        return fmt::format(
            "the display begins at {:.3g} m, and no object is farther than "
            "{:.3g} m: change \"near\"",
            observer.display.near, farthest);
    if (is_below_a_pixel(observer, image, (objects.min + objects.max) / 2.0, own_size))
        return fmt::format(
            "the objects around [{:.4g}, {:.4g}, {:.4g}] are smaller than a pixel: move the "
            "observer closer, use more pixels, or make them larger",
            middle.x, middle.y, middle.z);
    return fmt::format(
        "the objects lie around [{:.4g}, {:.4g}, {:.4g}]: make that the observer's "
        "\"look_at\", or move the observer",
        middle.x, middle.y, middle.z);
}

/// True if a material returns the light of emissive objects.
bool returns_light(const Material& material) {
    if (is_physical(material)) return true;
    const bool is_black = material.color == glm::vec3(0) && !material.checker;
    return (material.diffuse > 0 && !is_black) || material.specular.value_or(0) > 0;
}

/// True if objects can be anything but black.
bool shows_light(const Scene& scene) {
    const auto returns = [&](int material) {
        return returns_light(scene.materials[size_t(material)]);
    };
    return std::ranges::any_of(scene.objects, [&](const Object& object) {
        return object.visible &&
               (returns(object.material) ||
                std::ranges::any_of(object.groups, returns, &GroupMaterial::material));
    });
}

/// True if a warning says why its object is nowhere to be seen.
bool explains_loss(WarningKind kind) {
    return kind == WarningKind::outside_world || kind == WarningKind::unlikely_unit;
}

}  // namespace

RunWarnings::RunWarnings(std::vector<Warning> before, ModelCache cache, BatchWarnings warn)
    : warnings_(std::move(before)),
      told_(warnings_.size()),
      cache_(std::move(cache)),
      warn_(std::move(warn)) {
    if (!warnings_.empty()) warn_(warnings_);
}

bool RunWarnings::has(WarningKind kind) const {
    return std::ranges::find(warnings_, kind, &Warning::kind) != warnings_.end();
}

void RunWarnings::add(const FrameResult& result) {
    for (const Warning& warning : result.report.report.world.warnings) {
        const bool is_lost = warning.kind == WarningKind::no_voxels;
        if (is_lost && std::ranges::find(lost_, warning.where) == lost_.end())
            lost_.push_back(warning.where);
        const bool is_explained =
            is_lost && std::ranges::any_of(warnings_, [&](const Warning& known) {
                return known.where == warning.where && explains_loss(known.kind);
            });
        if (!is_explained) add_once(warning, warnings_);
    }
    const auto note = [this](const ShownContent& content) {
        content_.objects |= content.objects;
        content_.light |= content.objects && content.light;
    };
    if (result.bands) note(result.shown);
    if (result.image && !content_.light) note(content_of(*result.image));
    if (result.volume && !content_.light) note(content_of(*result.volume));
}

void RunWarnings::add_view_warning(const Scene& scene) {
    const bool has_objects = std::ranges::any_of(scene.objects, &Object::visible);
    const Medium& medium = scene.world.medium;
    if (!has_objects && (medium.color != glm::vec3(0) || has_medium_colors(medium)))
        return;  // a picture of fog, or of a scan
    const Bounds objects = box_of_objects(scene, AssetStore(cache_), lost_);
    const bool is_in_world = objects.min.x <= objects.max.x;
    if (has_objects && !is_in_world) return;  // known already
    const std::string advice =
        has_objects ? ": " + view_advice(scene.observer, frame_size(scene.render), objects,
                                         size_of_objects(scene, AssetStore(cache_)))
                    : ", as the scene has none that is visible: add some to \"objects\"";
    add_once({WarningKind::nothing_in_view, scene.observer.where,
              "no sight ray meets an object" + advice},
             warnings_);
}

void RunWarnings::add_light_warning(const Scene& scene) {
    if (has(WarningKind::light_inside_object) || has(WarningKind::observer_in_object)) return;
    if (!scene.render.channels.color || !shows_light(scene)) return;
    add_once({WarningKind::no_light, SourcePlace(scene.file.string()),
              "no light reaches what is in view, so it is black: move the lights to where nothing "
              "hides them, or give the world some \"ambient\" light"},
             warnings_);
}

void RunWarnings::end(const Scene& scene, std::span<const int> frames, bool is_part) {
    const Scene first = scene_at(scene, frames.front());
    const bool is_all = !is_part && scene.render.crop.is_whole();
    if (is_all && !content_.objects)
        add_view_warning(first);
    else if (is_all && !content_.light)
        add_light_warning(first);
    const std::span<const Warning> fresh = std::span(warnings_).subspan(told_);
    if (!fresh.empty()) warn_(fresh);
    told_ = warnings_.size();
}

}  // namespace voxelume
