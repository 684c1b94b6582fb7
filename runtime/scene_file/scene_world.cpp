// SPDX-License-Identifier: Apache-2.0
// The parts of a scene that don't refer to others: world, materials, animation, render settings.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "runtime/scene/fitted.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {
namespace {

constexpr std::array<std::string_view, 2> kShadowNames = {"opaque", "filtered"};
constexpr std::array<std::string_view, 2> kLightModes = {"local", "global"};
constexpr std::array<std::string_view, 3> kEmitterSearches = {"both", "paths", "rays"};

Bounds read_bounds(const SceneValue& value) {
    const SceneFields fields(value, "bounds");
    const Bounds bounds{fields.get("min").vector(kCoordinate),
                        fields.get("max").vector(kCoordinate)};
    for (int axis = 0; axis < 3; ++axis) {
        if (bounds.min[axis] >= bounds.max[axis]) {
            value.fail(fmt::format("empty along {}: min is {} and max is {}; max must be larger",
                                   "xyz"[axis], bounds.min[axis], bounds.max[axis]));
        }
    }
    return bounds;
}

/// Refuses values of Whitted's model that a physically based material replaces.
void refuse_both_models(const SceneFields& fields) {
    for (const std::string_view key : physical_keys()) {
        if (!fields.has(key)) continue;
        for (const std::string_view other : whitted_keys())
            if (const auto value = fields.find(other))
                value->fail(
                    fmt::format("belongs to Whitted's model, and \"{}\" to the physically "
                                "based one; leave one of them out",
                                key));
    }
}

Checker read_checker(const SceneValue& value) {
    const SceneFields fields(value, "checker");
    fields.get("size");
    Checker checker;
    fields.read_rows(checker_rows(), checker);
    check_checker(checker, fields.refusal());
    return checker;
}

}  // namespace

Material read_material(const std::string& name, const SceneValue& value) {
    const SceneFields fields(value, "material");
    Material m;
    m.name = name;
    fields.refuse_both("color", "base_color");
    refuse_both_models(fields);
    fields.read_rows(material_rows(), m);
    if (const auto checker = fields.find("checker")) m.checker = read_checker(*checker);
    return m;
}

World read_world(const SceneValue& value, const AssetSearch& search) {
    const SceneFields fields(value, "world");
    World world;
    world.where = value.where();
    fields.refuse_both("voxel_size", "resolution");
    if (const auto size = fields.find("voxel_size"))
        world.voxel_size = size->number_or_vector(kLength);
    world.resolution = fields.integer("resolution", 1, 65536, world.resolution);
    if (const auto bounds = fields.find("bounds")) {
        world.bounds = read_bounds(*bounds);
        if (!fields.has("voxel_size"))
            world.voxel_size = glm::dvec3(longest_side(world.bounds) / world.resolution);
        count_voxels(world);
    }
    fields.read_rows(world_rows(), world);
    if (const auto sky = fields.find("sky")) world.sky = read_sky(*sky, search);
    if (const auto medium = fields.find("medium")) world.medium = read_medium(*medium, search);
    return world;
}

std::vector<Material> read_materials(const SceneValue& value) {
    std::vector<Material> materials(1);
    materials[0].name = "default";
    for (const auto& [name, member] : value.named_members()) {
        if (name == "default") {
            materials[0] = read_material(name, member);
        } else {
            materials.push_back(read_material(name, member));
        }
    }
    return materials;
}

Animation read_animation(const SceneValue& value) {
    const SceneFields fields(value, "animation");
    Animation animation;
    animation.frames = fields.integer("frames", 1, 1'000'000, animation.frames);
    animation.fps = fields.number("fps", {0, 1000, true}, animation.fps);
    return animation;
}

namespace {

ReconstructionFilter read_filter(const SceneFields& fields) {
    ReconstructionFilter filter;
    if (const auto shape = fields.find("filter")) {
        std::array<std::string_view, 4> names;
        std::ranges::transform(filter_rows(), names.begin(), &FilterRow::name);
        filter.shape = FilterShape(shape->choice(names));
    }
    filter.width = fields.number("filter_width", kFilterWidth, filter_row(filter).default_width);
    return filter;
}

}  // namespace

RenderSettings read_render(const SceneValue& value) {
    constexpr Range kPixelAspects{0.1, 10};
    const SceneFields fields(value, "render");
    RenderSettings render;
    if (const auto size = fields.find("size")) {
        const auto parts = size->items();
        if (parts.size() != 2) size->fail(fmt::format("needs 2 numbers, not {}", parts.size()));
        render.size = {parts[0].integer(1, kMaxImageSide), parts[1].integer(1, kMaxImageSide)};
    }
    render.pixel_aspect = fields.number("pixel_aspect", kPixelAspects, render.pixel_aspect);
    render.samples = fields.integer("samples", 1, 4096, render.samples);
    render.adaptive = fields.number("adaptive", kRatio, render.adaptive);
    render.filter = read_filter(fields);
    render.depth = fields.integer("depth", 0, 64, render.depth);
    if (const auto shadows = fields.find("shadows")) render.shadows = shadows->boolean();
    if (const auto shadow = fields.find("shadow"))
        render.filtered_shadows = shadow->choice(kShadowNames) == 1;
    if (const auto light = fields.find("light"))
        render.light = LightMode(light->choice(kLightModes));
    if (const auto transparent = fields.find("transparent"))
        render.transparent = transparent->boolean();
    render.bounces = fields.integer("bounces", 0, 64, render.bounces);
    if (const auto emitters = fields.find("emitters"))
        render.emitters = EmitterSearch(emitters->choice(kEmitterSearches));
    render.min_weight = fields.number("least_weight", kRatio, render.min_weight);
    return render;
}

}  // namespace voxelume
