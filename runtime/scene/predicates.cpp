// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/predicates.hpp"

#include <algorithm>
#include <numeric>
#include <string_view>

#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/scene/parts/light.hpp"

namespace voxelume {
namespace {

/// The reason why an object can't be an instance; empty if it can.
std::string refusal(const Scene& scene, const Object& object) {
    const Model& model = scene.models[size_t(object.model)];
    if (transmits(scene, object) && shows_voxels(model.surface))
        return "a material of it lets light through, and rays go through cubes of the world only";
    if (model.solid && is_infinite(*model.solid)) return "its solid has no end";
    return "";
}

}  // namespace

Outside outside_of(const Scene& scene) {
    Outside outside{scene.world.background, scene.world.sky};
    if (!scene.render.transparent) return outside;
    if (!outside.sky && outside.background != glm::vec3(0)) {
        outside.sky.emplace();
        outside.sky->color = outside.background;
        outside.sky->samples = 0;
    }
    if (outside.sky) outside.sky->visible = false;
    outside.background = glm::vec3(0);
    return outside;
}

std::vector<int> materials_of_groups(const Object& object,
                                     const std::vector<std::string>& group_names) {
    const std::vector<std::string_view> known(group_names.begin(), group_names.end());
    std::vector<int> materials(std::max<size_t>(known.size(), 1), object.material);
    for (const GroupMaterial& entry : object.groups) {
        const auto found = std::find(known.begin(), known.end(), entry.group);
        if (found == known.end()) {
            throw Error(ErrorKind::scene, "{}: the mesh has no group of faces named {}{}",
                        entry.where, quote(entry.group), suggest(entry.group, known));
        }
        materials[found - known.begin()] = entry.material;
    }
    return materials;
}

std::vector<uint32_t> object_ranks(const std::vector<Object>& objects) {
    std::vector<uint32_t> order(objects.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(
        order, [&](uint32_t a, uint32_t b) { return objects[a].priority > objects[b].priority; });
    std::vector<uint32_t> ranks(objects.size());
    for (uint32_t rank = 0; rank < order.size(); ++rank) ranks[order[rank]] = rank;
    return ranks;
}

bool transmits(const Material& material) {
    return (effects_of(material) & (kRefracts | kIsSeenThrough)) != 0;
}

bool transmits(const Scene& scene, const Object& object) {
    return transmits(scene.materials[size_t(object.material)]) ||
           std::ranges::any_of(object.groups, [&](const GroupMaterial& group) {
               return transmits(scene.materials[size_t(group.material)]);
           });
}

std::vector<uint32_t> coincidence_order(const Scene& scene) {
    const bool has_exact = std::ranges::any_of(scene.objects, [&](const Object& object) {
        return lists_primitives(scene.models[size_t(object.model)].surface);
    });
    if (scene.objects.size() < 2 || !has_exact) return {};
    std::vector<uint32_t> order = object_ranks(scene.objects);
    for (size_t i = 0; i < order.size(); ++i)
        if (transmits(scene, scene.objects[i])) order[i] += uint32_t(order.size());
    return order;
}

bool has_emission(const Scene& scene, const Object& object) {
    const auto emits = [&](int material) {
        return (effects_of(scene.materials[size_t(material)]) & kEmits) != 0;
    };
    return emits(object.material) ||
           std::ranges::any_of(object.groups, emits, &GroupMaterial::material);
}

bool is_emissive(const Scene& scene, const Object& object) {
    return object.visible && object.light_samples.value_or(1) > 0 && has_emission(scene, object);
}

bool has_scattering(const Scene& scene) {
    return scene.render.light == LightMode::global && scene.world.medium.scattering != glm::vec3(0);
}

bool has_placed_light(const Scene& scene) {
    return std::ranges::any_of(scene.lights, [](const Light& light) {
        return shines(light) && type_of(light).has_position;
    });
}

bool shines(const Light& light) {
    return light.intensity != glm::vec3(0) && !light.is_dark;
}

bool has_area(const Light& light) {
    return type_of(light).area != nullptr;
}

bool has_area_light(const Scene& scene) {
    return std::ranges::any_of(scene.lights,
                               [](const Light& light) { return shines(light) && has_area(light); });
}

bool may_meet_lights(const Scene& scene) {
    const RenderSettings& render = scene.render;
    const bool shadows_let_light_through =
        render.filtered_shadows && std::ranges::any_of(scene.objects, [&](const Object& object) {
            return object.visible && transmits(scene, object);
        });
    return render.light == LightMode::global && render.bounces > 0 && render.shadows &&
           !shadows_let_light_through && has_area_light(scene);
}

bool shows_inside(const Scene& scene, const Object& object) {
    const Model& model = scene.models[size_t(object.model)];
    return shows_voxels(model.surface) && model.set == VoxelSet::solid && transmits(scene, object);
}

bool can_be_instance(const Scene& scene, const Object& object) {
    return refusal(scene, object).empty();
}

bool is_instanced(const Scene& scene, const Object& object) {
    if (object.placement == Placement::automatic)
        return object.moves && !transmits(scene, object) && can_be_instance(scene, object);
    return object.placement == Placement::instance;
}

void check_placements(const Scene& scene) {
    for (const Object& object : scene.objects) {
        if (object.placement != Placement::instance) continue;
        const std::string reason = refusal(scene, object);
        if (!reason.empty())
            throw Error(ErrorKind::scene,
                        "{}: the object \"{}\" can't be placed as an instance: {}; give it "
                        "\"placement\": \"world\"",
                        object.where, object.name, reason);
    }
}

HollowObjects hollow_objects(const Scene& scene) {
    HollowObjects hollow;
    bool has_smooth = false;
    for (const Object& object : scene.objects) {
        const Model& model = scene.models[size_t(object.model)];
        const bool has_form = model.solid.has_value() && lists_primitives(model.surface);
        const bool is_apart = is_instanced(scene, object) && !shows_voxels(model.surface);
        const bool is_hollow =
            transmits(scene, object) && (is_apart || (!has_form && !shows_voxels(model.surface)));
        const bool is_united = is_hollow && !is_apart && stores_distances(model.surface);
        hollow.flags.push_back(is_hollow);
        hollow.maximum += is_hollow && !is_united;
        has_smooth |= is_united;
    }
    hollow.maximum += has_smooth;
    return hollow;
}

}  // namespace voxelume
