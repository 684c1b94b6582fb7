// SPDX-License-Identifier: Apache-2.0
// One job of `render`: a scene to its files.
#include "cli/render_job.hpp"

#include <CLI/CLI.hpp>
#include <chrono>

#include "cli/checks.hpp"
#include "cli/progress.hpp"
#include "cli/render_report.hpp"
#include "cli/warnings.hpp"

namespace voxelume::cli {
namespace {

/// The channels of OpenEXR files that `--channels` names.
Channels listed_channels(const RenderCommand& command) {
    Channels channels{false, false, false, false, false};
    for (const std::string& name : CLI::detail::split(command.channels, ',')) {
        if (name == "RGBA")
            channels.color = true;
        else if (name == "Z")
            channels.depth = true;
        else if (name == "distance")
            channels.distance = true;
        else if (name == "P")
            channels.position = true;
        else if (name == "N")
            channels.normal = true;
        else if (name == "objectId")
            channels.object = true;
        else
            fail_usage("render: --channels: \"{}\" is none of RGBA, Z, distance, P, N and objectId",
                       name);
    }
    return channels;
}

/// A line for logs, by which a farm follows an animation; a bar shows people as much.
void tell_written(const FrameFiles& files) {
    for (const auto* paths : {&files.images, &files.volumes})
        for (const std::filesystem::path& path : *paths)
            fmt::print(stderr, "frame {}: {}\n", files.frame, path.string());
}

/// Renders the files of a job, and tells of them while it does.
Statistics render_files(const Scene& scene, const std::vector<Device>& devices, FrameJob job,
                        const RenderCommand& command, const std::string& label) {
    Progress bar(label, 100 * job.frames.size(), stderr, command.quiet);
    uint64_t shown = 0;
    RenderOptions render;
    render.cache = cache_options(command.scene);
    render.overlap = !command.one_by_one;
    render.time_kernels = command.verbose || !command.stats.empty();
    render.progress = [&](double done, int) {
        const auto now = uint64_t(done * 100 * double(job.frames.size()));
        bar.advance(now - shown);
        shown = now;
    };
    render.compiling = [&bar](int kernel, int known) {
        bar.say(fmt::format("compiling kernels: {} of {}", kernel, known));
    };
    render.strict = command.scene.strict;
    if (!command.quiet) render.warn = warning_printer(render.strict, [&bar] { bar.clear(); });
    const bool tells =
        !command.quiet && job.frames.size() > 1 && !describe_terminal(stderr).draws_bars;
    if (tells)
        job.deliver = [files = job.frames.begin()](const RenderedFrame&) mutable {
            tell_written(*files++);
        };
    return render_frames(scene, devices, job, render);
}

}  // namespace

const std::vector<Device>& LazyDevices::open() {
    if (devices_.empty()) devices_ = Device::open_all(selector_);
    return devices_;
}

void render_job(const RenderCommand& command, LazyDevices& lazy_devices, const std::string& label) {
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [start] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    FrameJob job;
    job.image_files = {command.exposure, command.float_color, listed_channels(command)};
    const Scene scene = read_with(command.scene, "render");
    job.frames = frame_files(command, scene);
    check_files(job.frames, scene, command);
    const std::vector<Device>& devices = lazy_devices.open();
    if (command.plan_only) {
        print_plan(scene, devices[0],
                   {numbers_of(job.frames), needed_channels(job), cache_options(command.scene)},
                   {.quiet = command.quiet, .strict = command.scene.strict});
        return;
    }
    if (!command.quiet && scene.has_default_light())
        fmt::print(stderr, "note: {}\n",
                   harmless_line(fmt::format("{}: has no \"lights\", so one shines from the "
                                             "observer's upper left; \"lights\": [] is dark",
                                             scene.file().string())));
    const double open_seconds = seconds();
    Statistics statistics = render_files(scene, devices, std::move(job), command, label);
    statistics.open_seconds += open_seconds;
    statistics.total_seconds = seconds();
    if (!command.stats.empty()) write_file(command.stats, to_json(statistics));
    if (command.quiet) return;
    print_summary(statistics);
    if (command.verbose) print_details(statistics);
}

}  // namespace voxelume::cli
