// SPDX-License-Identifier: Apache-2.0
// Scene -> lines for people.
#include <fmt/format.h>

#include <glm/trigonometric.hpp>

#include "runtime/scene/parts/light.hpp"
#include "runtime/scene/parts/observer.hpp"
#include "runtime/scene/parts/solid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/scene/scene_motion.hpp"

namespace voxelume {
namespace {

std::string vector_text(glm::dvec3 v) {
    return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z);
}

std::string solid_text(const Solid& solid) {
    std::string text(solid_types()[static_cast<size_t>(solid.kind)].name);
    if (is_combination(solid.kind)) text += fmt::format(" of {} parts", solid.parts.size());
    return text;
}

/// The name of a model's surface; `auto` if it depends on files which aren't read yet.
std::string_view surface_text(const Model& model) {
    const bool is_unknown = model.is_surface_open && model.surface_reason.empty();
    return is_unknown ? "auto" : kind_of(model.surface).name;
}

std::string model_text(const Model& model) {
    const std::string source =
        model.solid ? solid_text(*model.solid)
                    : (model.voxels.empty() ? model.mesh : model.voxels).filename().string();
    const FileMap& map = model.object_from_file;
    const std::string scaled = map.scale == 1 ? "" : fmt::format(" scaled by {:.6g}", map.scale);
    if (!model.voxels.empty())
        return fmt::format("model \"{}\": {}{}{}, {}", model.name, source,
                           model.part > 0 ? fmt::format(" part {}", model.part) : "", scaled,
                           surface_text(model));
    const std::string cut =
        model.cuts.empty() ? "" : fmt::format(", cut by {} solids", model.cuts.size());
    const std::string pitch =
        model.resolution > 0 ? fmt::format("{} voxels along the longest side", model.resolution)
                             : fmt::format("voxels of {} m", vector_text(model.voxel_size));
    return fmt::format("model \"{}\": {}{}{}, {}, {}", model.name, source, scaled, cut,
                       surface_text(model), pitch);
}

std::string light_text(const Light& light) {
    const LightType& type = type_of(light);
    const bool has_position = type.has_position;
    return fmt::format("light \"{}\": {}, {} {}, intensity {}", light.name, type.name,
                       has_position ? "at" : "along",
                       vector_text(has_position ? light.position : light.direction),
                       vector_text(light.intensity));
}

std::string density_text(const Density& density) {
    if (const auto* height = std::get_if<HeightDensity>(&density))
        return fmt::format(", density 1 up to y {:.6g}, above it a factor of e less every {:.6g} m",
                           height->base, height->scale_height);
    if (const auto* ball = std::get_if<BallDensity>(&density))
        return fmt::format(", density of a ball at {}, radius {:.6g}", vector_text(ball->center),
                           ball->radius);
    if (const auto* grid = std::get_if<GridDensity>(&density)) {
        std::string text = fmt::format(", density of grid \"{}\" of {}", grid->grid,
                                       grid->file.filename().string());
        for (const GridDensity& other : grid->others)
            text +=
                fmt::format(", and of \"{}\" of {}", other.grid, other.file.filename().string());
        return text;
    }
    return "";
}

std::string medium_text(const Medium& medium) {
    std::string scattering;
    if (medium.scattering != glm::vec3(0))
        scattering = fmt::format(", scattering {} per m, anisotropy {:.6g}",
                                 vector_text(glm::dvec3(medium.scattering)), medium.anisotropy);
    return fmt::format("medium: absorption {} per m{}{}\n",
                       vector_text(glm::dvec3(medium.absorption)), scattering,
                       density_text(medium.density));
}

std::string projection_text(const Observer& observer) {
    if (observer.projection == Projection::panoramic) return "panoramic, ";
    if (observer.projection != Projection::orthographic) return "";
    const glm::dvec2 size = 2.0 * observer.display.half_size;
    return fmt::format("orthographic, {:.6g} x {:.6g} m, ", size.x, size.y);
}

std::string observer_text(const Observer& observer) {
    const Display& d = observer.display;
    const std::string blades =
        observer.blades > 0 ? fmt::format(" and {} blades", observer.blades) : "";
    const std::string lens = observer.aperture > 0
                                 ? fmt::format(", lens of {:.6g} m{}, sharp at {:.6g} m",
                                               observer.aperture, blades, observer.focus)
                                 : "";
    const std::string shutter =
        observer.shutter > 0 ? fmt::format(", shutter open for {:.6g} frames", observer.shutter)
                             : "";
    return fmt::format(
        "observer: at {}, looking along {}, {}{} display of {}x{}x{} voxels, from {:.6g} to "
        "{:.6g} m{}{}",
        vector_text(observer.position), vector_text(observer.world_from_observer[2]),
        projection_text(observer), shape_row(d).name, d.voxels.x, d.voxels.y, d.voxels.z, d.near,
        d.far, lens, shutter);
}

std::string filter_text(const ReconstructionFilter& filter) {
    if (filter.is_pixel()) return "";
    return fmt::format(", {} filter {:.6g} pixels wide", filter_row(filter).name, filter.width);
}

}  // namespace

std::string describe(const Scene& scene) {
    const World& world = scene.world;
    std::string text = fmt::format("world: {}x{}x{} voxels of {} m\n", world.voxels.x,
                                   world.voxels.y, world.voxels.z, vector_text(world.voxel_size));
    if (world.medium.absorption != glm::vec3(0) || world.medium.scattering != glm::vec3(0))
        text += medium_text(world.medium);
    for (const Model& model : scene.models) text += model_text(model) + "\n";
    for (const Object& object : scene.objects) {
        text += fmt::format("object \"{}\": model \"{}\", material \"{}\", at {}\n", object.name,
                            scene.models[object.model].name, scene.materials[object.material].name,
                            vector_text(object.world_from_object[3]));
    }
    for (const Light& light : scene.lights) text += light_text(light) + "\n";
    text += observer_text(scene.observer) + "\n";
    if (scene.motion)
        text +=
            fmt::format("animation: {} frames, {:.6g} a second, {} moving parts\n",
                        scene.animation.frames, scene.animation.fps, scene.motion->parts.size());
    const RenderSettings& render = scene.render;
    const std::string light = render.light == LightMode::global
                                  ? fmt::format("global light of {} bounces", render.bounces)
                                  : fmt::format("depth {}", render.depth);
    text += fmt::format("image: {}x{} pixels, {} samples each{}, {}, shadows {}\n", render.size.x,
                        render.size.y, render.samples, filter_text(render.filter), light,
                        render.shadows ? "on" : "off");
    return text;
}

}  // namespace voxelume
