#include "cli/scene_options.hpp"

#include <CLI/CLI.hpp>

#include "cli/checks.hpp"
#include "runtime/base/error.hpp"

namespace voxelume::cli {
void add_scene_options(CLI::App& app, SceneOptions& options) {
    app.add_option("SCENE", options.scene, "the scene, JSON (see scenes/README.md)")->required();
    app.add_option("--assets", options.assets, "folder of models that the scene names")
        ->allow_extra_args(false);
    app.add_option("--size", options.size, "WIDTHxHEIGHT in pixels, instead of the scene's");
    app.add_option("--samples", options.samples, "samples per pixel, instead of the scene's")
        ->check(in_range(1, 4096, Number::whole));
    app.add_option("--device", options.device,
                   "auto, cpu, gpu, a number, part of a name, or all to share frames and tiles");
    app.add_flag("--no-cache", options.no_cache, "neither read nor keep models' voxels on disk");
}

ModelCache model_cache(const SceneOptions& options) {
    return options.no_cache ? ModelCache() : ModelCache::of_user();
}

Scene read_with(const SceneOptions& options, const char* command) {
    const glm::ivec2 size =
        options.size.empty() ? glm::ivec2(0) : parse_size(options.size, command);
    Scene scene = read_scene(options.scene, asset_folders(options.assets));
    if (size.x != 0) resize(scene, size);
    if (options.samples != 0) scene.render.samples = options.samples;
    return scene;
}

}  // namespace voxelume::cli
