// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/moved_part.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/error.hpp"
#include "runtime/scene/parts/solid.hpp"
#include "runtime/scene/track_values.hpp"

namespace voxelume {
namespace {

/// The scale of a track on its way through 0, limited to a sheet of a ten-thousandth of its longest
/// side, with the sign that it has.
glm::dvec3 without_flatness(glm::dvec3 scale) {
    const double min = 1e-4 * std::max({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)});
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(scale[axis]) < min) scale[axis] = std::copysign(min, scale[axis]);
    return scale;
}

}  // namespace

MovedPart::MovedPart(const MovingPart& part, const std::string& file, double frame, Scene& scene)
    : part_(part), file_(file), frame_(frame), scene_(scene), placements_(part.placements) {
    if (const auto* light = std::get_if<LightParameters>(&part.parameters)) light_ = *light;
    if (const auto* observer = std::get_if<ObserverParameters>(&part.parameters))
        observer_ = *observer;
}

void MovedPart::apply() {
    for (const FileSequence& sequence : part_.sequences)
        *std::get<std::filesystem::path*>(slot(sequence.value, {})) = sequence.at(frame_);
    for (const Track& track : part_.tracks) set(track);
    form();
}

void MovedPart::set(const Track& track) {
    const Slot to = slot(track.value, track.solid);
    if (track.files.empty()) return put(to, values_of(track, frame_), track.item);
    *std::get<std::filesystem::path*>(to) = track.files[key_before(track.keys.frames, frame_)];
    if (part_.part == ScenePart::world)
        std::get<GridDensity>(scene_.world.medium.density).where = where(track.path);
}

void MovedPart::form() {
    switch (part_.part) {
        case ScenePart::world:
            return build_world();
        case ScenePart::material:
            if (const auto& checker = scene_.materials[part_.index].checker)
                check_checker(*checker, refusal("checker"));
            return;
        case ScenePart::model:
            return form_model();
        case ScenePart::object:
            return place_object();
        case ScenePart::light: {
            Light& light = scene_.lights[part_.index];
            return set_light(type_of(light), light_, refusal(""), light);
        }
        case ScenePart::observer:
            place_observer(observer_, refusal(""), scene_.observer);
            return form_display(scene_.observer);
    }
}

void MovedPart::build_world() {
    Density& density = scene_.world.medium.density;
    if (const auto* ball = std::get_if<BallDensity>(&density))
        check_ball(*ball, refusal("medium.density."));
    for (const MovingPlacement& placement : placements_)
        std::get<GridDensity>(density).world_from_grid = placed(placement);
}

void MovedPart::place_object() {
    if (placements_.empty()) return;
    std::vector<glm::dmat4> links = part_.links;
    for (const MovingPlacement& placement : placements_) {
        const std::vector<size_t>& parent = placement.solid.parts;
        Factors factors = placement.factors;
        if (has_scale_track(placement.solid)) factors.scale = without_flatness(factors.scale);
        links[parent.empty() ? links.size() - 1 : parent.front()] = affine_from_factors(factors);
    }
    const glm::dmat4 map = product_of(links);
    Object& object = scene_.objects[part_.index];
    if (is_safely_invertible(stretch_of(glm::dmat3(map))))
        object.world_from_object = map;
    else
        object.visible = false;
}

bool MovedPart::has_scale_track(const SolidPath& solid) const {
    return std::ranges::any_of(part_.tracks, [&](const Track& track) {
        const auto* const row = std::get_if<const ValueRow<Factors>*>(&track.value);
        return row && (*row)->key == "scale" && track.solid == solid;
    });
}

void MovedPart::form_model() {
    for (const Track& track : part_.tracks) {
        if (!std::holds_alternative<const ValueRow<Solid>*>(track.value)) continue;
        const size_t key = track.path.rfind('.');
        check_solid(solid_at(track.solid),
                    refusal(key == track.path.npos ? "" : track.path.substr(0, key + 1)));
    }
    for (const MovingPlacement& placement : placements_)
        solid_at(placement.solid).parent_from_solid = placed(placement);
}

void MovedPart::form_display(Observer& observer) {
    const DisplaySetting setting{distance_to_farthest_corner(scene_.world, observer.position),
                                 proportions(scene_.render)};
    if (observer.projection != Projection::display)
        return project(observer_, setting, refusal(""), observer);
    Display display;
    display.shape = observer.display.shape;
    shape_row(display).measure(observer_.display, setting, refusal("display."), display);
    display.voxels = observer.display.voxels;
    display.layout = observer.display.layout;
    display.visibility = observer.display.visibility;
    display.seen_along = observer.display.seen_along;
    display.cylinder = observer.display.cylinder;
    observer.display = display;
}

Slot MovedPart::slot(const ValueReference& value, const SolidPath& solid) {
    Medium& medium = scene_.world.medium;
    const auto placement = [&]() -> Factors& {
        return std::ranges::find(placements_, solid, &MovingPlacement::solid)->factors;
    };
    struct Finder {
        MovedPart& of;
        Medium& medium;
        const SolidPath& solid;
        decltype(placement)& factors;

        Slot operator()(const ValueRow<World>* row) { return row->slot(of.scene_.world); }
        Slot operator()(const ValueRow<Medium>* row) { return row->slot(medium); }
        Slot operator()(const ValueRow<HeightDensity>* row) {
            return row->slot(std::get<HeightDensity>(medium.density));
        }
        Slot operator()(const ValueRow<BallDensity>* row) {
            return row->slot(std::get<BallDensity>(medium.density));
        }
        Slot operator()(const ValueRow<GridDensity>* row) {
            return row->slot(std::get<GridDensity>(medium.density));
        }
        Slot operator()(const ValueRow<Material>* row) { return row->slot(material()); }
        Slot operator()(const ValueRow<Checker>* row) { return row->slot(*material().checker); }
        Slot operator()(const ValueRow<Model>* row) { return row->slot(model()); }
        Slot operator()(const ValueRow<Morph>* row) { return row->slot(*model().morph); }
        Slot operator()(const ValueRow<Solid>* row) { return row->slot(of.solid_at(solid)); }
        Slot operator()(const ValueRow<Factors>* row) { return row->slot(factors()); }
        Slot operator()(const ValueRow<Object>* row) {
            return row->slot(of.scene_.objects[of.part_.index]);
        }
        Slot operator()(const ValueRow<LightParameters>* row) { return row->slot(of.light_); }
        Slot operator()(const ValueRow<ObserverParameters>* row) { return row->slot(of.observer_); }
        Slot operator()(const ValueRow<DisplayParameters>* row) {
            return row->slot(of.observer_.display);
        }

        Material& material() { return of.scene_.materials[of.part_.index]; }
        Model& model() { return of.scene_.models[of.part_.index]; }
    };
    return std::visit(Finder{*this, medium, solid, placement}, value);
}

Solid& MovedPart::solid_at(const SolidPath& path) {
    Model& model = scene_.models[part_.index];
    size_t step = 0;
    Solid* solid = path.is_cut ? &model.cuts[path.parts[step++]] : &*model.solid;
    while (step < path.parts.size()) solid = &solid->parts[path.parts[step++]];
    return *solid;
}

glm::dmat4 MovedPart::placed(const MovingPlacement& placement) const {
    const glm::dmat4 map = affine_from_factors(placement.factors);
    if (!is_safely_invertible(stretch_of(glm::dmat3(map))))
        check_map(map, "scale", refusal(placement.path));
    return map;
}

Refuse MovedPart::refusal(const std::string& prefix) const {
    return [this, prefix](std::string_view key, const std::string& sentence) {
        throw Error(ErrorKind::scene, "{}: {}", where(prefix + std::string(key)), sentence);
    };
}

SourcePlace MovedPart::where(std::string_view path) const {
    TextPosition at;
    for (const ValueOrigin& origin : part_.origins)
        if (origin.path == path) at = origin.at;
    for (const Track& track : part_.tracks)
        if (track.item < 0 && track.path == path)
            at = track.at[key_before(track.keys.frames, frame_)];
    return {file_, at.line, at.column,
            fmt::format("{}{}{}", part_.path, path.empty() ? "" : ".", path)};
}

}  // namespace voxelume
