// SPDX-License-Identifier: Apache-2.0
// Scenes for callers.
#include "runtime/voxelume/scene.hpp"

#include "runtime/api/convert.hpp"
#include "runtime/api/guarded.hpp"
#include "runtime/api/handles.hpp"
#include "runtime/api/process.hpp"
#include "runtime/api/tree.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {

v1::Scene api::handle_of(Scene scene) {
    return v1::Scene(std::make_shared<const v1::Scene::Implementation>(
        v1::Scene::Implementation{std::move(scene)}));
}

namespace v1 {

Scene Scene::load(const std::filesystem::path& file, const SceneOptions& options) {
    return api::guarded([&] {
        api::apply_process_options();
        return api::handle_of(read_scene(file, asset_folders(options.assets)));
    });
}

Scene Scene::parse(std::string_view text, const std::filesystem::path& file,
                   const SceneOptions& options) {
    return api::guarded([&] {
        api::apply_process_options();
        return api::handle_of(parse_scene(text, file, asset_folders(options.assets)));
    });
}

Scene Scene::build(const SceneDescription& description, const SceneOptions& options) {
    return api::guarded([&] {
        api::apply_process_options();
        const JsonValue document = api::tree(description);
        return api::handle_of(
            read_scene(document, description.name, asset_folders(options.assets)));
    });
}

Scene Scene::with_size(Size size) const {
    return api::guarded([&] {
        voxelume::Scene scene = api::inside(*this);
        resize(scene, api::vector_of(size));
        return api::handle_of(std::move(scene));
    });
}

Scene Scene::with_samples(int samples) const {
    return api::guarded([&] {
        if (samples < 1 || samples > 4096)
            throw voxelume::Error(voxelume::ErrorKind::usage,
                                  "an image has from 1 to 4096 samples a pixel, not {}", samples);
        voxelume::Scene scene = api::inside(*this);
        scene.render.samples = samples;
        return api::handle_of(std::move(scene));
    });
}

const std::filesystem::path& Scene::file() const {
    return api::inside(*this).file;
}

Size Scene::size() const {
    return api::array_of(api::inside(*this).render.size);
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

std::string Scene::describe() const {
    return voxelume::describe(api::inside(*this));
}

}  // namespace v1
}  // namespace voxelume
