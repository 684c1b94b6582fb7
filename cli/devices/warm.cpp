// SPDX-License-Identifier: Apache-2.0
// voxelume warm SCENE...: fills the cache with what rendering the scenes needs.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "cli/output/channels.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/complaint.hpp"
#include "cli/shared/interrupt.hpp"
#include "cli/shared/scene_options.hpp"
#include "cli/shared/tell.hpp"
#include "cli/shared/warnings.hpp"

namespace voxelume::cli {
namespace {

struct WarmCommand {
    SceneOptions scene;
    std::vector<std::string> inputs;
    std::string frames = "1", channels = "RGBA,Z,P,N,objectId";
    bool volume = false, quiet = false;
};

/// Renders a scene's frames without writing them, and says what had to be compiled.
void warm_up(const WarmCommand& command, const std::string& input) {
    const auto start = std::chrono::steady_clock::now();
    SceneOptions options = command.scene;
    options.scene = input;
    const Scene scene = read_with(options, "warm");
    FrameJob job;
    for (const int frame : parse_frame_list(command.frames)) job.frames.push_back({frame, {}, {}});
    job.deliver_images = true;
    job.deliver_volumes = command.volume;
    const Interruptible interruptible;
    RenderOptions render;
    render.cache = cache_options(options);
    render.stop = interruptible.stop();
    render.strict = options.strict;
    int compiled = 0;
    render.compiling = [&](int, int) { ++compiled; };
    if (!command.quiet) render.warn = warning_printer(false, [] {});
    // Pictures have their own kernels, which compute only colour. A newly opened device builds the
    // programs that a new process will look for, and keeps them when it is closed.
    const Channels channels = parse_channels(command.channels, "warm: --channels");
    for (const Channels& wanted : {channels, kColorAlone}) {
        render.channels = wanted;
        render_frames(scene, Device::open_all(command.scene.device), job, render);
        render.warn = {};
        job.deliver_volumes = false;
    }
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    if (!command.quiet)
        tell("{}: {} in {:.1f} s\n", harmless_line(input),
             compiled > 0 ? fmt::format("{} kernels compiled", compiled)
                          : std::string("nothing to compile"),
             passed.count());
}

int run(const WarmCommand& command) {
    const std::filesystem::path folder = user_cache_folder();
    if (folder.empty())
        fail_usage(
            "warm: there is no cache to fill: VOXELUME_CACHE_DIR names no folder to write to");
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    if (!std::filesystem::is_directory(folder, ignored) || access(folder.c_str(), W_OK | X_OK) != 0)
        throw Error(ErrorKind::output,
                    fmt::format("warm: nothing can be written to {}, the cache; have "
                                "VOXELUME_CACHE_DIR name another folder",
                                folder.string()));
    set_limits(command.scene, "warm");
    tell_unread_bases(command.quiet);
    int code = 0;
    for (const std::string& input : command.inputs) {
        try {
            warm_up(command, input);
        } catch (const Error& error) {
            const bool is_last = error.kind() == ErrorKind::cancelled ||
                                 error.kind() == ErrorKind::device || command.inputs.size() == 1;
            if (is_last) throw;
            complain(error.what(), error.kind());
            const int failure = error.exit_code();
            code = code == 0 || code == failure ? failure : static_cast<int>(ErrorKind::render);
        }
    }
    if (!command.quiet) tell("the cache is {}\n", folder.string());
    return code;
}

}  // namespace

Action add_warm(CLI::App& app) {
    const auto command = std::make_shared<WarmCommand>();
    app.add_option("SCENE", command->inputs, "scene files, JSON, or model files")->required();
    add_scene_options(app, command->scene);
    app.add_option("--frames", command->frames,
                   "frames to render into nothing, like 1,20; the first by default")
        ->type_name("FRAMES");
    app.add_option("--channels", command->channels,
                   "channels that images will have, as `render --channels` names them")
        ->type_name("CHANNELS");
    app.add_flag("--volume", command->volume, "prepare volumetric images, too");
    app.add_flag("-q,--quiet", command->quiet, "print errors only");
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
