// SPDX-License-Identifier: Apache-2.0
// Scenes for callers.
#include "runtime/voxelume/scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "runtime/api/border/convert.hpp"
#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/api/border/process.hpp"
#include "runtime/api/read_handle.hpp"
#include "runtime/api/tree/tree.hpp"
#include "runtime/api/voxel_array.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/text.hpp"
#include "runtime/import/scene_of_file.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/document/document_hash.hpp"
#include "runtime/scene_file/document/orbit.hpp"
#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {
namespace {

/// Throws Error::input for a file whose name isn't that of a scene and which doesn't begin as one.
void refuse_other_files(const std::filesystem::path& file) {
    std::string ending = ending_of(file);
    if (ending == ".gz") ending = ending_of(file.stem()) + ending;  // such as .nii.gz
    if (ending.empty() || ending == ".json" || !std::filesystem::is_regular_file(file)) return;
    try {
        const InputFile input(file);
        std::string start(std::min<uint64_t>(input.size(), 4096), '\0');
        input.read(0, start.data(), start.size());
        const size_t first = start.find_first_not_of(" \t\r\n");
        if (first != std::string::npos && (start[first] == '{' || start[first] == '\xEF')) return;
    } catch (const Error&) {
        return;  // reading reports the reason
    }
    throw Error(ErrorKind::input,
                "{}: files that end in {} aren't read: scenes end in .json, and models in {}",
                SourcePlace(file.string()), ending, fmt::join(model_file_endings(), " "));
}

}  // namespace

std::optional<AssetStore> api::ReadAssets::take(const v1::CacheOptions& cache) {
    const std::lock_guard lock(mutex_);
    const bool is_same = cache.enabled == cache_.enabled && cache.folder == cache_.folder &&
                         cache.max_megabytes == cache_.max_megabytes;
    return is_same ? std::exchange(store_, std::nullopt) : std::nullopt;
}

v1::Scene api::handle_of(Scene scene, std::string hash, std::shared_ptr<ReadAssets> read) {
    return v1::Scene(std::make_shared<const v1::Scene::Implementation>(
        v1::Scene::Implementation{std::move(scene), std::move(hash), std::move(read)}));
}

AssetStore api::assets_of(const v1::Scene& scene, const v1::CacheOptions& cache) {
    const std::shared_ptr<ReadAssets>& read = scene.implementation().read;
    std::optional<AssetStore> store = read ? read->take(cache) : std::nullopt;
    return store ? std::move(*store) : AssetStore(model_cache(cache));
}

v1::Scene api::read_handle(const v1::SceneOptions& options, const ReadScene& read) {
    return guarded([&] {
        apply_process_options();
        std::optional<AssetStore> store;
        const auto store_now = [&]() -> AssetStore& {
            if (!store) store.emplace(model_cache(options.cache));
            return *store;
        };
        const FileBoxes boxes = [&](const Model& model, bool is_first) {
            try {
                return store_now().box_of_file(model, is_first);
            } catch (const Error& error) {
                throw Error(error.kind(), "{}: {}", model.where, error.what());
            }
        };
        std::string hash;
        std::vector<SceneChange> changes;
        changes.reserve(options.changes.size());
        for (const v1::SceneChange& change : options.changes)
            changes.push_back(
                {change.path, change.value, change.origin.empty() ? change.path : change.origin});
        Scene scene = read({asset_folders(options.assets), boxes, store_now, std::move(changes),
                            options.orbit, hash, given_voxels(options.voxels)});
        std::shared_ptr<ReadAssets> assets;
        if (store) assets = std::make_shared<ReadAssets>(std::move(*store), options.cache);
        return handle_of(std::move(scene), std::move(hash), std::move(assets));
    });
}

Scene api::read_with_changes(const JsonValue& document, const std::filesystem::path& file,
                             const SceneFiles& files) {
    return read_changed(document, files.changes, [&](const JsonValue& changed) {
        Scene scene = read_scene(changed, file, files.assets, files.boxes, files.given);
        files.hash = document_hash(changed);
        if (files.orbit == 0) return scene;
        const JsonValue turned = orbited(changed, scene, files.orbit);
        files.hash = document_hash(turned);
        return read_scene(turned, file, files.assets, files.boxes, files.given);
    });
}

namespace v1 {

Scene Scene::load(const std::filesystem::path& file, const SceneOptions& options) {
    return api::read_handle(options, [&](const api::SceneFiles& files) {
        refuse_other_files(file);
        return api::read_with_changes(read_document(file), file, files);
    });
}

Scene Scene::parse(std::string_view text, const std::filesystem::path& file,
                   const SceneOptions& options) {
    return api::read_handle(options, [&](const api::SceneFiles& files) {
        JsonValue document = parse_json(text, file.string());
        if (!options.has_lines) forget_places(document);
        return api::read_with_changes(document, file, files);
    });
}

Scene Scene::build(const SceneDescription& description, const SceneOptions& options) {
    return api::read_handle(options, [&](const api::SceneFiles& files) {
        return api::read_with_changes(api::tree(description), description.name, files);
    });
}

Scene Scene::with_size(Size size) const {
    return api::guarded([&] {
        voxelume::Scene scene = api::inside(*this);
        resize(scene, api::vector_of(size));
        return api::handle_of(std::move(scene), implementation().hash, implementation().read);
    });
}

Scene Scene::with_crop(Size first, Size size) const {
    return api::guarded([&] {
        voxelume::Scene scene = api::inside(*this);
        crop(scene, api::vector_of(first), api::vector_of(size));
        return api::handle_of(std::move(scene), implementation().hash, implementation().read);
    });
}

Scene Scene::with_samples(int samples) const {
    return api::guarded([&] {
        if (samples < 1 || samples > 4096)
            throw voxelume::Error(voxelume::ErrorKind::usage,
                                  "an image has from 1 to 4096 samples a pixel, not {}", samples);
        voxelume::Scene scene = api::inside(*this);
        scene.render.samples = samples;
        return api::handle_of(std::move(scene), implementation().hash, implementation().read);
    });
}

Scene Scene::with_noise(double error, double seconds, int max_samples) const {
    return api::guarded([&] {
        if (!(error >= 0) || !(seconds >= 0) || error + seconds == 0 ||
            !std::isfinite(error + seconds))
            throw voxelume::Error(voxelume::ErrorKind::usage,
                                  "an image's noise and seconds are numbers of at least 0, and one "
                                  "of them is above 0, not {} and {}",
                                  error, seconds);
        if (max_samples < 32 || max_samples > 4096)
            throw voxelume::Error(voxelume::ErrorKind::usage,
                                  "an image by noise or time, whose samples double from 16 on, "
                                  "takes a maximum of 32 to 4096 samples a pixel, not {}",
                                  max_samples);
        voxelume::Scene scene = api::inside(*this);
        scene.render.samples = max_samples;
        scene.render.noise = {error, seconds};
        check_tiles(scene.render);
        return api::handle_of(std::move(scene), implementation().hash, implementation().read);
    });
}

Scene Scene::with_light(LightMode light) const {
    return api::guarded([&] {
        voxelume::Scene scene = api::inside(*this);
        scene.render.light =
            light == LightMode::global ? voxelume::LightMode::global : voxelume::LightMode::local;
        return api::handle_of(std::move(scene), implementation().hash, implementation().read);
    });
}

const std::filesystem::path& Scene::file() const {
    return api::inside(*this).file;
}

Size Scene::size() const {
    return api::array_of(api::inside(*this).render.size);
}

double Scene::pixel_aspect() const {
    return api::inside(*this).render.pixel_aspect;
}

bool Scene::moves() const {
    return voxelume::moves(api::inside(*this));
}

int Scene::frames() const {
    return api::inside(*this).animation.frames;
}

double Scene::frames_per_second() const {
    return api::inside(*this).animation.fps;
}

std::vector<std::string> Scene::object_names() const {
    std::vector<std::string> names;
    for (const voxelume::Object& object : api::inside(*this).objects) names.push_back(object.name);
    return names;
}

std::string Scene::fitted() const {
    return fitted_text(api::inside(*this));
}

bool Scene::has_default_light() const {
    return api::inside(*this).has_default_light;
}

std::string Scene::describe() const {
    return voxelume::describe(api::inside(*this));
}

}  // namespace v1
}  // namespace voxelume
