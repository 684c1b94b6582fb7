// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/warnings/scene_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "runtime/analysis/warnings/effect_warnings.hpp"
#include "runtime/analysis/warnings/inside_warnings.hpp"
#include "runtime/analysis/warnings/mesh_warnings.hpp"
#include "runtime/analysis/warnings/object_warnings.hpp"
#include "runtime/base/files/disk_cache.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_animation.hpp"

namespace voxelume {
namespace {

constexpr size_t kMaxFrames = 64;

std::vector<int> some_of(std::span<const int> frames) {
    if (frames.size() <= kMaxFrames) return {frames.begin(), frames.end()};
    std::vector<int> some;
    some.reserve(kMaxFrames);
    for (size_t i = 0; i < kMaxFrames; ++i)
        some.push_back(frames[i * (frames.size() - 1) / (kMaxFrames - 1)]);
    return some;
}

/// True if something in the scene sends light to surfaces, or shows light of its own.
bool has_any_light(const Scene& scene) {
    const World& world = scene.world;
    const bool has_background = world.background != glm::vec3(0) || world.sky;
    const auto shows_light = [&](const Object& object) {
        const uint32_t effects = effects_of(scene.materials[size_t(object.material)]);
        return object.visible &&
               (has_emission(scene, object) ||
                (has_background && ((effects & kReflects) != 0 || transmits(scene, object))));
    };
    const bool is_global = scene.render.light == LightMode::global && scene.render.bounces > 0;
    const bool has_sky = has_sun(world) || (world.sky && world.sky->samples > 0);
    return world.ambient != glm::vec3(0) || has_sky || (is_global && has_background) ||
           world.medium.color != glm::vec3(0) || std::ranges::any_of(scene.lights, shines) ||
           std::ranges::any_of(scene.objects, shows_light);
}

void add_light_warning(const Scene& scene, std::vector<Warning>& warnings) {
    const bool has_objects = std::ranges::any_of(scene.objects, &Object::visible);
    if (!has_objects || !scene.render.channels.color || has_any_light(scene)) return;
    add_once({WarningKind::no_light, SourcePlace(scene.file.string()),
              "nothing in this scene shines, so its objects are black: add one of \"lights\", or "
              "give the world some \"ambient\" light"},
             warnings);
}

/// Adds the warning that a folder of the cache keeps nothing, and what each run does because of it.
void add_cache_warning(const std::filesystem::path& folder, const std::string& refusal,
                       const char* consequence, std::vector<Warning>& warnings) {
    if (refusal.empty()) return;
    add_once({WarningKind::cache_not_writable, SourcePlace(folder.string()),
              fmt::format("nothing can be kept in this folder ({}), so each run {}", refusal,
                          consequence)},
             warnings);
}

void add_cache_warnings(const ModelCache& cache, std::vector<Warning>& warnings) {
    if (!cache.is_open()) return;  // who wants none needn't hear of it
    const std::string models = cache.refusal();
    const DiskCache programs(programs_folder(), 0);
    const std::string refusal = programs.refusal();
    const bool has_one_cause =
        models == refusal && cache.folder().parent_path() == programs.folder().parent_path();
    add_cache_warning(cache.folder(), models,
                      has_one_cause ? "voxelizes and compiles everything again: name another one "
                                      "with VOXELUME_CACHE_DIR, or use --no-cache"
                                    : "voxelizes everything again: name another one, or use "
                                      "--no-cache",
                      warnings);
    if (has_one_cause) return;
    add_cache_warning(programs.folder(), refusal,
                      "compiles all kernels again: name another one with VOXELUME_CACHE_DIR",
                      warnings);
}

/// True if an object shows the same file, or a solid, as in another frame.
bool shows_same_file(const Scene& a, const Scene& b, size_t object) {
    const Model& m = a.models[size_t(a.objects[object].model)];
    const Model& n = b.models[size_t(b.objects[object].model)];
    return m.mesh == n.mesh && m.voxels == n.voxels && m.morph == n.morph;
}

/// The warnings of a later frame that are among `candidates`.
std::vector<Warning> still_true(const Scene& first, const Scene& now,
                                const std::vector<Warning>& candidates, AssetStore& meshes) {
    std::vector<Warning> found;
    const auto is_doubted = [&](const SourcePlace& where) {
        return std::ranges::any_of(candidates,
                                   [&](const Warning& warning) { return warning.where == where; });
    };
    for (size_t i = 0; i < now.objects.size(); ++i)
        if (is_doubted(now.objects[i].where) && shows_same_file(first, now, i))
            add_object_warnings(now, now.objects[i], meshes, found);
    const auto is_of_place = [](const Warning& warning) {
        return warning.kind == WarningKind::light_inside_object ||
               warning.kind == WarningKind::observer_in_object;
    };
    if (std::ranges::any_of(candidates, is_of_place)) add_inside_warnings(now, meshes, found);
    add_light_warning(now, found);
    add_effect_warnings(now, found);
    return found;
}

}  // namespace

std::vector<Warning> scene_warnings(const Scene& scene, std::span<const int> frames,
                                    AssetStore& meshes) {
    std::vector<Warning> lasting, warnings;
    add_cache_warnings(meshes.cache(), lasting);
    std::optional<Scene> first;
    for (const int frame : some_of(frames)) {
        if (first && (warnings.empty() || !moves(scene))) break;
        in_frame(scene, frame, [&] {
            Scene now = scene_at(scene, frame);
            if (first) {
                const std::vector<Warning> found = still_true(*first, now, warnings, meshes);
                std::erase_if(warnings, [&](const Warning& before) {
                    return std::ranges::none_of(
                        found, [&](const Warning& w) { return is_same(w, before); });
                });
                return;
            }
            for (const Object& object : now.objects) {
                add_mesh_warnings(now, object, meshes, lasting);
                add_object_warnings(now, object, meshes, warnings);
            }
            add_inside_warnings(now, meshes, warnings);
            add_light_warning(now, warnings);
            add_effect_warnings(now, warnings);
            first = std::move(now);
        });
    }
    for (Warning& warning : warnings) add_once(std::move(warning), lasting);
    return lasting;
}

}  // namespace voxelume
