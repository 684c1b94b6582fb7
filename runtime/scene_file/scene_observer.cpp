// SPDX-License-Identifier: Apache-2.0
// The observer with its display.
#include <fmt/format.h>

#include <array>

#include "runtime/scene/parts/observer.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {
namespace {

const DisplayShapeRow& display_shape(const SceneValue& value) {
    return display_shapes()[kind_of(value, "shape", "display")];
}

SceneFields display_fields(const SceneValue& value) {
    return {value, fmt::format("display:{}", display_shape(value).name)};
}

DisplayParameters read_display_parameters(const SceneValue& value) {
    DisplayParameters parameters;
    display_fields(value).read_kind(display_shape(value).keys, display_rows(), parameters);
    return parameters;
}

constexpr std::array<std::string_view, 5> kSeenAlong = {"observer", "facing", "x", "y", "z"};

constexpr std::array<std::string_view, 3> kProjections = {"perspective", "orthographic",
                                                          "panoramic"};

/// The projection that replaces a display; `perspective` is done by a pyramid.
Projection read_projection(const SceneFields& fields) {
    const auto name = fields.find("projection");
    const auto projection = name ? Projection(name->choice(kProjections)) : Projection::display;
    if (projection != Projection::display && fields.has("display"))
        fields.get("display").fail(
            fmt::format("\"projection\": \"{}\" makes the display; leave one of them out",
                        kProjections[size_t(projection)]));
    if (name && projection == Projection::display &&
        display_shape(fields.get("display")).projection != SightProjection::perspective)
        name->fail("\"perspective\" needs a display of the shape \"pyramid\"");
    if (projection != Projection::orthographic)
        for (const char* key : {"width", "height"})
            if (const auto value = fields.find(key))
                value->fail("needs \"projection\": \"orthographic\"");
    return projection;
}

/// Reads the layout of the display's voxels, and which of them it has.
void read_volume(const SceneFields& fields, Display& display) {
    using Pair = std::array<std::string_view, 2>;
    using Sights = std::array<std::string_view, 3>;
    if (const auto layout = fields.find("layout"))
        display.layout = static_cast<VolumeLayout>(layout->choice(Pair{"rays", "lattice"}));
    const bool is_lattice = display.layout == VolumeLayout::lattice;
    const auto visibility = fields.find("visibility");
    if (visibility)
        display.visibility =
            static_cast<Visibility>(visibility->choice(Sights{"observer", "outside", "all"}));
    if (display.visibility != Visibility::observer && !is_lattice)
        visibility->fail("needs \"layout\": \"lattice\": rays show what their observer sees");
    if (display.visibility != Visibility::observer) display.seen_along = SeenAlong::facing;
    if (const auto along = fields.find("seen_along")) {
        display.seen_along = static_cast<SeenAlong>(along->choice(kSeenAlong));
        if (!is_lattice)
            along->fail("needs \"layout\": \"lattice\": rays are seen along themselves");
    }
    const auto clip = fields.find("clip");
    if (clip) display.cylinder = clip->choice(Pair{"shape", "cylinder"}) == 1;
    if (display.cylinder && !is_lattice)
        clip->fail("needs \"layout\": \"lattice\": rays end with their display's shape");
}

void read_voxels(const SceneFields& fields, glm::ivec2 image_size, Display& display) {
    constexpr int kMaxDisplaySide = 65536;
    display.voxels = {image_size, 256};
    const auto voxels = fields.find("voxels");
    if (!voxels) return;
    const auto counts = voxels->items();
    if (counts.size() != 3) voxels->fail(fmt::format("needs 3 numbers, not {}", counts.size()));
    for (int i = 0; i < 3; ++i) display.voxels[i] = counts[i].integer(1, kMaxDisplaySide);
}

Display read_display(const SceneValue& value, const Scene& scene, glm::dvec3 position) {
    const SceneFields fields = display_fields(value);
    const DisplayShapeRow& shape = display_shape(value);
    Display display;
    display.shape = shape.shape;
    shape.measure(read_display_parameters(value),
                  {distance_to_farthest_corner(scene.world, position), proportions(scene.render)},
                  fields.refusal(), display);
    read_volume(fields, display);
    read_voxels(fields, scene.render.size, display);
    return display;
}

ObserverParameters read_place(const SceneFields& fields) {
    fields.get("position");
    ObserverParameters parameters;
    fields.read_rows(observer_rows(), parameters);
    return parameters;
}

}  // namespace

ObserverParameters read_observer_parameters(const SceneValue& value) {
    const SceneFields fields(value, "observer");
    ObserverParameters parameters = read_place(fields);
    if (read_projection(fields) == Projection::display)
        parameters.display = read_display_parameters(fields.get("display"));
    return parameters;
}

Observer read_observer(const SceneValue& value, const Scene& scene) {
    const SceneFields fields(value, "observer");
    Observer observer;
    observer.where = value.where();
    const ObserverParameters place = read_place(fields);
    place_observer(place, fields.refusal(), observer);
    observer.projection = read_projection(fields);
    if (observer.projection == Projection::display) {
        observer.display = read_display(fields.get("display"), scene, observer.position);
    } else {
        const DisplaySetting setting{distance_to_farthest_corner(scene.world, observer.position),
                                     proportions(scene.render)};
        project(place, setting, fields.refusal(), observer);
        observer.display.voxels = {scene.render.size, 256};
    }
    if (observer.aperture > 0 &&
        shape_row(observer.display).projection != SightProjection::perspective)
        fields.get("aperture")
            .fail("a lens needs a perspective: a display of the shape \"pyramid\"");
    return observer;
}

}  // namespace voxelume
