// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench_whitted.hpp"

#include <memory>
#include <nlohmann/json.hpp>

#include "runtime/base/json_text.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/verify/analytic/analytic_tracer.hpp"
#include "runtime/verify/bench/bench.hpp"

namespace voxelume {
namespace {

/// A scene with its tracer, which keeps a reference to it.
struct TracedScene {
    Scene scene = whitted_scene(Surface::exact, 64, {64, 64});
    oracle::AnalyticTracer tracer{scene};
};

}  // namespace

Scene whitted_scene(Surface surface, int resolution, glm::ivec2 size) {
    auto document = parse_json_text<nlohmann::json>(whitted_text(), nullptr, true);
    document["world"]["voxel_size"] = 1.0 / resolution;
    auto& models = document["models"];
    if (!lists_primitives(surface)) {
        // Overlapping objects' voxels are united, so only a difference makes the glass hollow.
        for (const char* name : {"outside", "hollow"}) models[name].erase("surface");
        models["outside"] = {{"shape", "difference"},
                             {"parts", {models["outside"], models["hollow"]}}};
        auto& objects = document["objects"];
        std::erase_if(objects.get_ref<nlohmann::json::array_t&>(),
                      [](const auto& object) { return object["name"] == "hollow"; });
        models.erase("hollow");
        document["materials"].erase("air");
    }
    for (auto& [name, model] : models.items()) model["surface"] = name_of(surface);
    Scene scene = parse_scene(document.dump(), "whitted.json", {});
    resize(scene, size);
    return scene;
}

BenchSubject whitted_subject() {
    const auto traced = std::make_shared<const TracedScene>();
    BenchSubject subject;
    subject.name = "whitted";
    subject.scene = whitted_scene;
    subject.first_hit = [traced](const glm::dvec3& origin, const glm::dvec3& direction) {
        std::optional<AnalyticHit> nearest;
        for (const Object& object : traced->scene.objects) {
            const Solid& solid = *traced->scene.models[size_t(object.model)].solid;
            const auto hit = analytic_hit(solid, object.world_from_object, origin, direction);
            if (hit && (!nearest || hit->t < nearest->t)) nearest = hit;
        }
        return nearest;
    };
    subject.radiance = [traced](const glm::dvec3& origin, const glm::dvec3& direction) {
        return traced->tracer.trace(origin, direction).radiance;
    };
    return subject;
}

}  // namespace voxelume
