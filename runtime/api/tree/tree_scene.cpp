// SPDX-License-Identifier: Apache-2.0
// The lights, observer, tracks and settings of a description, and all of it, as the scene format
// has them.
#include <array>
#include <set>

#include "runtime/api/tree/tree.hpp"
#include "runtime/base/error.hpp"
#include "runtime/scene_file/document/scene_fields.hpp"

namespace voxelume::api {
namespace {

void add_source(const v1::PointLight& light, ObjectTree& object) {
    object.add("type", "point").add("position", light.position);
}

void add_source(const v1::DirectionalLight& light, ObjectTree& object) {
    object.add("type", "directional").add("direction", light.direction);
}

/// Adds the keys of lights that are aimed.
template <class Aimed>
void add_aim(const Aimed& light, ObjectTree& object) {
    object.add("position", light.position);
    object.add("direction", light.direction).add("look_at", light.look_at);
}

void add_source(const v1::SpotLight& light, ObjectTree& object) {
    add_aim(light, object.add("type", "spot"));
    object.add("angle", light.angle).add("inner_angle", light.inner_angle);
}

void add_source(const v1::DiskLight& light, ObjectTree& object) {
    add_aim(light, object.add("type", "disk"));
    object.add("radius", light.radius).add("spots", light.samples);
}

void add_source(const v1::RectangleLight& light, ObjectTree& object) {
    add_aim(light, object.add("type", "rectangle"));
    object.add("size", light.size).add("up", light.up).add("spots", light.samples);
}

void add_shape(const v1::PyramidDisplay& display, ObjectTree& object) {
    object.add("shape", "pyramid").add("angles", display.angles).add("angle", display.angle);
    object.add("near", display.near).add("far", display.far);
}

void add_shape(const v1::SectorDisplay& display, ObjectTree& object) {
    object.add("shape", "sector").add("angle", display.angle);
    object.add("near", display.near).add("far", display.far);
}

void add_shape(const v1::BallDisplay& display, ObjectTree& object) {
    object.add("shape", "ball").add("radius", display.radius);
}

void add_shape(const v1::BoxDisplay& display, ObjectTree& object) {
    object.add("shape", "box").add("size", display.size).add("near", display.near);
}

JsonValue tree_of_display(const v1::Display& display) {
    constexpr std::array kLayouts = {"rays", "lattice"};
    constexpr std::array kSeenAlong = {"observer", "facing", "x", "y", "z"};
    constexpr std::array kVisibilities = {"observer", "outside", "all"};
    ObjectTree object;
    std::visit([&object](const auto& shape) { add_shape(shape, object); }, display.shape);
    object.add("voxels", display.voxels).add("layout", kLayouts.at(size_t(display.layout)));
    if (display.visibility) object.add("visibility", kVisibilities.at(size_t(*display.visibility)));
    if (display.seen_along) object.add("seen_along", kSeenAlong.at(size_t(*display.seen_along)));
    return object.add("clip", display.cylinder ? "cylinder" : "shape").take();
}

JsonValue tree_of_track(const v1::Track& track) {
    constexpr std::array kInterpolations = {"step", "linear", "cubic", "slerp", "spline"};
    std::vector<JsonValue> items;
    std::visit(
        [&items](const auto& keys) {
            for (const auto& key : keys) {
                ObjectTree object;
                object.add("frame", key.frame).add("value", key.value);
                items.push_back(object.add("in", key.in).add("out", key.out).take());
            }
        },
        track.keys);
    ObjectTree object;
    object.add("target", track.target).put("keys", list_of(std::move(items)));
    if (track.interpolation)
        object.add("interpolation", kInterpolations.at(size_t(*track.interpolation)));
    return object.take();
}

template <class Part>
JsonValue tree_of_list(const std::vector<Part>& parts) {
    std::vector<JsonValue> items;
    items.reserve(parts.size());
    for (const Part& part : parts) items.push_back(tree(part));
    return list_of(std::move(items));
}

/// An object with the parts under their names, which must differ. `section` is the scene's key for
/// them.
template <class Part>
JsonValue tree_by_name(const std::vector<Part>& parts, const std::string& section,
                       const std::string& file) {
    ObjectTree object;
    std::set<std::string_view> names;
    for (const Part& part : parts) {
        if (!names.insert(part.name).second)
            throw Error(ErrorKind::scene, "{}: another of the {} is named {} already",
                        SourcePlace(file, 0, 0, section), section, quote(part.name));
        object.put(part.name, tree(part));
    }
    return object.take();
}

}  // namespace

JsonValue tree(const v1::Material& material) {
    ObjectTree object;
    const bool is_physical = material.base_color || material.metallic || material.roughness ||
                             material.transmission || material.coat || material.coat_roughness;
    if (is_physical) {
        object.add("base_color", material.base_color.value_or(material.color));
        if (material.metallic) object.add("metallic", *material.metallic);
        if (material.roughness) object.add("roughness", *material.roughness);
        if (material.transmission) object.add("transmission", *material.transmission);
        if (material.coat) object.add("coat", *material.coat);
        if (material.coat_roughness) object.add("coat_roughness", *material.coat_roughness);
    } else {
        object.add("color", material.color).add("diffuse", material.diffuse);
        object.add("shininess", material.shininess);
        object.add("reflection", material.reflection).add("refraction", material.refraction);
        object.add("fresnel", material.fresnel);
    }
    if (material.specular) object.add("specular", *material.specular);
    object.add("ior", material.ior)
        .add("opacity", material.opacity)
        .add("absorption", material.absorption);
    object.add("emission", material.emission);
    if (const auto& checker = material.checker) {
        ObjectTree inner;
        inner.add("color", checker->color).add("size", checker->size);
        object.put("checker", inner.add("origin", checker->origin).take());
    }
    return object.take();
}

JsonValue tree(const v1::Light& light) {
    ObjectTree object;
    object.add_text("name", light.name).add_text("group", light.group);
    std::visit([&object](const auto& source) { add_source(source, object); }, light.source);
    return object.add("color", light.color).add("intensity", light.intensity).take();
}

JsonValue tree(const v1::Observer& observer) {
    ObjectTree object;
    object.add("position", observer.position).add("look_at", observer.look_at);
    object.add("up", observer.up).add("turn", observer.turn);
    object.add("aperture", observer.aperture).add("focus", observer.focus);
    object.add("blades", observer.blades).add("shutter", observer.shutter);
    if (observer.projection == v1::Projection::display)
        return object.put("display", tree_of_display(observer.display)).take();
    constexpr std::array kProjections = {"perspective", "orthographic", "panoramic"};
    object.add("projection", kProjections.at(size_t(observer.projection)));
    return object.add("width", observer.width).add("height", observer.height).take();
}

JsonValue tree(const v1::Animation& animation) {
    std::vector<JsonValue> tracks;
    tracks.reserve(animation.tracks.size());
    for (const v1::Track& track : animation.tracks) tracks.push_back(tree_of_track(track));
    ObjectTree object;
    object.add("frames", animation.frames).add("fps", animation.frames_per_second);
    return object.put("tracks", list_of(std::move(tracks))).take();
}

const char* name_of(v1::EmitterSearch emitters) {
    switch (emitters) {
        case v1::EmitterSearch::paths:
            return "paths";
        case v1::EmitterSearch::rays:
            return "rays";
        case v1::EmitterSearch::both:
            break;
    }
    return "both";
}

JsonValue tree(const v1::RenderSettings& render) {
    constexpr std::array kFilters = {"box", "tent", "gaussian", "blackman-harris"};
    ObjectTree object;
    object.add("size", render.size).add("samples", render.samples).add("depth", render.depth);
    object.add("pixel_aspect", render.pixel_aspect);
    object.add("adaptive", render.adaptive);
    object.add("shadows", render.shadows);
    object.add("shadow", render.filtered_shadows ? "filtered" : "opaque");
    object.add("light", render.light == v1::LightMode::global ? "global" : "local");
    object.add("bounces", render.bounces).add("emitters", name_of(render.emitters));
    object.add("filter", kFilters.at(size_t(render.filter)));
    object.add("filter_width", render.filter_width).add("transparent", render.transparent);
    return object.add("least_weight", render.min_weight).take();
}

JsonValue tree(const v1::SceneDescription& description) {
    const std::string& name = description.name;
    ObjectTree object;
    object.add("voxelume", 1).put("world", tree(description.world));
    object.put("materials", tree_by_name(description.materials, "materials", name));
    object.put("models", tree_by_name(description.models, "models", name));
    object.put("objects", tree_of_list(description.objects));
    if (description.lights) object.put("lights", tree_of_list(*description.lights));
    if (description.observer) object.put("observer", tree(*description.observer));
    object.put("animation", tree(description.animation));
    return object.put("render", tree(description.render)).take();
}

}  // namespace voxelume::api
