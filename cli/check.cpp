// voxelume check SCENE: whether a scene is right, and what rendering it takes.
#include <CLI/CLI.hpp>
#include <memory>
#include <numeric>
#include <vector>

#include "cli/commands.hpp"
#include "cli/scene_options.hpp"
#include "runtime/scene_file/scene_animation.hpp"

namespace voxelume::cli {

Action add_check(CLI::App& app) {
    struct Options {
        SceneOptions scene;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    add_scene_options(app, options->scene);
    app.add_flag("--json", options->json, "print the plan as JSON");
    return [options] {
        const Scene scene = read_with(options->scene, "check");
        std::vector<int> frames(moves(scene) ? size_t(scene.animation.frames) : 1);
        std::iota(frames.begin(), frames.end(), 1);
        print_plan(scene, frames, Device::open(options->scene.device), model_cache(options->scene),
                   options->json);
        return 0;
    };
}

}  // namespace voxelume::cli
