// SPDX-License-Identifier: Apache-2.0
// What is in a scene.
#include <cstdint>
#include <filesystem>
#include <string>

#include "runtime/api/describe/describe.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/json_text.hpp"
#include "runtime/scene/parts/light.hpp"
#include "runtime/scene/parts/observer.hpp"
#include "runtime/scene/parts/solid.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume::api {

namespace {

Report list_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Report model_row(const Model& model) {
    const bool is_unknown = model.is_surface_open && model.surface_reason.empty();
    const std::filesystem::path& file = model.voxels.empty() ? model.mesh : model.voxels;
    return {
        {"model", model.name},
        {"of", model.solid ? std::string(solid_types()[static_cast<size_t>(model.solid->kind)].name)
                           : file.string()},
        {"surface", is_unknown ? "auto" : kind_of(model.surface).name}};
}

Report object_row(const Scene& scene, const Object& object) {
    return {{"object", object.name},
            {"model", scene.models[object.model].name},
            {"material", scene.materials[object.material].name},
            {"at", list_of(object.world_from_object[3])}};
}

Report light_row(const Light& light) {
    const LightType& type = type_of(light);
    return {{"light", light.name},
            {"type", type.name},
            {"at", type.has_position ? list_of(light.position) : Report()},
            {"along", type.has_direction ? list_of(light.direction) : Report()},
            {"intensity", list_of(glm::dvec3(light.intensity))}};
}

}  // namespace

Report describe_scene(const Scene& scene) {
    const World& world = scene.world;
    const Observer& observer = scene.observer;
    Report report = {{"kind", "scene"},
                     {"pixels", {scene.render.size.x, scene.render.size.y}},
                     {"samples", scene.render.samples},
                     {"light", scene.render.light == LightMode::global ? "global" : "local"},
                     {"frames", scene.animation.frames}};
    if (scene.motion) report["frames a second"] = scene.animation.fps;
    report["world"] = {world.voxels.x, world.voxels.y, world.voxels.z};
    report["voxel edges"] = list_of(world.voxel_size);
    report["observer"] = list_of(observer.position);
    report["looking along"] = list_of(observer.world_from_observer[2]);
    if (observer.projection != Projection::display)
        report["projection"] =
            observer.projection == Projection::panoramic ? "panoramic" : "orthographic";
    report["display"] = shape_row(observer.display).name;
    const glm::ivec3 voxels = observer.display.voxels;
    report["display voxels"] = {voxels.x, voxels.y, voxels.z};
    report["models"] = Report::array();
    for (const Model& model : scene.models) report["models"].push_back(model_row(model));
    report["objects"] = Report::array();
    for (const Object& object : scene.objects)
        report["objects"].push_back(object_row(scene, object));
    report["lights"] = Report::array();
    for (const Light& light : scene.lights) report["lights"].push_back(light_row(light));
    return report;
}

bool is_scene(const std::filesystem::path& path) {
    constexpr uint64_t kLongestHeader = uint64_t{1} << 24;
    const InputFile file(path);
    if (file.size() > kLongestHeader) return true;
    const auto json = parse_json_text<Report>(file.read_all(kLongestHeader));
    if (json.is_discarded()) return true;
    return json.is_object() && (json.contains("voxelume") || json.contains("objects"));
}

}  // namespace voxelume::api
