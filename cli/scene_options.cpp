// SPDX-License-Identifier: Apache-2.0
#include "cli/scene_options.hpp"

#include <CLI/CLI.hpp>

#include "cli/checks.hpp"

namespace voxelume::cli {

void add_scene_options(CLI::App& app, SceneOptions& options) {
    app.add_option("SCENE", options.scene,
                   "scene file, JSON (see scenes/README.md), or a model file: .obj .ply .stl .vxm "
                   ".vdb .vox")
        ->required();
    app.add_option("--assets", options.assets,
                   "folder to look for the scene's models in; may be given again")
        ->allow_extra_args(false);
    app.add_option("--size", options.size,
                   "image size, WIDTHxHEIGHT in pixels; replaces the scene's");
    app.add_option("--samples", options.samples, "samples per pixel; replaces the scene's")
        ->check(in_range(1, 4096, Number::whole));
    app.add_option(
           "--light", options.light,
           "light of flat images: local, or global with all that surfaces reflect; replaces "
           "the scene's")
        ->check(one_of({"local", "global"}));
    app.add_option(
        "--device", options.device,
        "device: auto, cpu, gpu, a number, part of a name, or all to share frames and tiles");
    app.add_flag("--no-cache", options.no_cache,
                 "neither read nor write the cache of models and worlds");
    app.add_flag("--strict", options.strict, "take warnings for errors, exit code 3");
    add_import_options(app, options.import);
}

CacheOptions cache_options(const SceneOptions& options) {
    return {.enabled = !options.no_cache};
}

Scene read_with(const SceneOptions& options, const char* command) {
    const Size size = options.size.empty() ? Size{} : parse_size(options.size, command);
    const v1::SceneOptions files{options.assets, cache_options(options)};
    const bool is_model = is_model_file(options.scene);
    if (!is_model) refuse_choices(options.import, command);
    Scene scene =
        is_model ? scene_of_file(options.scene, options_of(options.import, size, command), files)
                 : Scene::load(options.scene, files);
    if (size[0] != 0) scene = scene.with_size(size);
    if (options.samples != 0) scene = scene.with_samples(options.samples);
    if (!options.light.empty())
        scene = scene.with_light(options.light == "global" ? LightMode::global : LightMode::local);
    return scene;
}

}  // namespace voxelume::cli
