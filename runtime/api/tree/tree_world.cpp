// SPDX-License-Identifier: Apache-2.0
// The world of a description, its medium and its sky, as the scene format has them.
#include "runtime/api/tree/tree.hpp"

namespace voxelume::api {
namespace {

JsonValue tree_of_density(const v1::HeightDensity& density) {
    ObjectTree object;
    object.add("kind", "height").add("base", density.base);
    return object.add("scale_height", density.scale_height).take();
}

JsonValue tree_of_density(const v1::BallDensity& density) {
    ObjectTree object;
    object.add("kind", "ball").add("center", density.center);
    return object.add("radius", density.radius).add("falloff", density.falloff).take();
}

/// Adds the members that each of several scans in a medium has.
void add_scan(const v1::GridDensity& density, ObjectTree& object) {
    object.add("file", density.file.string()).add("grid", density.grid);
    if (density.sequence) object.put("sequence", tree(*density.sequence));
    std::vector<JsonValue> points;
    for (const v1::TransferPoint& point : density.transfer) {
        ObjectTree item;
        item.add("value", point.value).add("absorption", point.absorption);
        points.push_back(item.add("color", point.color).take());
    }
    if (!points.empty()) object.put("transfer", list_of(std::move(points)));
    if (density.is_lit_by_scene) object.add("lit", true);
    add_pose(density, object.add("lit", density.lit));
}

JsonValue tree_of_density(const v1::GridDensity& density) {
    ObjectTree object;
    add_scan(density, object.add("kind", "grid"));
    std::vector<JsonValue> others;
    for (const v1::GridDensity& other : density.others) {
        ObjectTree item;
        add_scan(other, item);
        others.push_back(item.take());
    }
    if (!others.empty()) object.put("others", list_of(std::move(others)));
    return object.take();
}

JsonValue tree_of_medium(const v1::Medium& medium) {
    ObjectTree object;
    const auto* const grid = std::get_if<v1::GridDensity>(&medium.density);
    if (!grid || grid->transfer.empty() || medium.absorption != v1::Color{})
        object.add("absorption", medium.absorption);
    object.add("color", medium.color);
    if (medium.scattering != v1::Color{}) object.add("scattering", medium.scattering);
    if (medium.anisotropy != 0) object.add("anisotropy", medium.anisotropy);
    std::visit(
        [&object](const auto& density) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(density)>, std::monostate>)
                object.put("density", tree_of_density(density));
        },
        medium.density);
    return object.take();
}

void add_kind(const v1::ConstantSky& sky, ObjectTree& object) {
    object.add("kind", "constant").add("color", sky.color);
}

void add_kind(const v1::GradientSky& sky, ObjectTree& object) {
    object.add("kind", "gradient").add("zenith", sky.zenith);
    object.add("horizon", sky.horizon).add("ground", sky.ground);
}

void add_kind(const v1::SunSky& sky, ObjectTree& object) {
    object.add("kind", "sun").add("direction", sky.direction).add("angle", sky.angle);
    object.add("color", sky.color).add("intensity", sky.intensity);
    object.add("turbidity", sky.turbidity).add("ground", sky.ground);
}

void add_kind(const v1::MapSky& sky, ObjectTree& object) {
    object.add("kind", "map").add("file", sky.file.string()).add("rotation", sky.rotation);
}

JsonValue tree_of_sky(const v1::Sky& sky) {
    ObjectTree object;
    std::visit([&object](const auto& kind) { add_kind(kind, object); }, sky.kind);
    object.add("strength", sky.strength).add("samples", sky.samples);
    return object.add("visible", sky.visible).take();
}

}  // namespace

JsonValue tree(const v1::World& world) {
    constexpr v1::Vec3 kNone{};
    ObjectTree bounds, object;
    if (world.voxel_size != kNone) object.add("voxel_size", world.voxel_size);
    object.add("resolution", world.resolution);
    if (world.min != kNone || world.max != kNone)
        object.put("bounds", bounds.add("min", world.min).add("max", world.max).take());
    object.add("background", world.background);
    if (world.ambient != kNone) object.add("ambient", world.ambient);
    if (world.medium) object.put("medium", tree_of_medium(*world.medium));
    if (world.sky) object.put("sky", tree_of_sky(*world.sky));
    return object.take();
}

}  // namespace voxelume::api
