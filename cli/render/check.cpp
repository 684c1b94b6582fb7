// SPDX-License-Identifier: Apache-2.0
// voxelume check SCENE: says whether a scene is valid, and what rendering it takes.
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/shared/commands.hpp"
#include "cli/shared/scene_options.hpp"

namespace voxelume::cli {

Action add_check(CLI::App& app) {
    struct Options {
        SceneOptions scene;
        bool json = false, quiet = false;
    };
    const auto options = std::make_shared<Options>();
    app.add_option("SCENE", options->scene.scene,
                   "scene file, JSON (see scenes/README.md), or a model file (see "
                   "scenes/manual/model_files.md): " +
                       model_endings())
        ->required();
    add_scene_options(app, options->scene);
    app.add_flag("--json", options->json, "print the plan as JSON");
    app.add_flag("-q,--quiet", options->quiet, "print no warnings");
    return [options] {
        set_limits(options->scene, "check");
        const Scene scene = read_with(options->scene, "check");
        print_plan(scene, options->scene.device, {.cache = cache_options(options->scene)},
                   {options->json, options->quiet, options->scene.strict, true});
        return 0;
    };
}

}  // namespace voxelume::cli
