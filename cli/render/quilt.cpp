// SPDX-License-Identifier: Apache-2.0
#include "cli/render/quilt.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <optional>
#include <utility>

#include "cli/render/finished_files.hpp"
#include "cli/render/frame_files.hpp"
#include "cli/render/render_job.hpp"
#include "cli/render/render_progress.hpp"
#include "cli/render/render_report.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/interrupt.hpp"
#include "cli/shared/scene_options.hpp"
#include "cli/shared/tell.hpp"
#include "cli/shared/warnings.hpp"

namespace voxelume::cli {
namespace {

namespace fs = std::filesystem;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The option that asks for a quilt or a stereo pair.
const char* option_of(const QuiltChoices& choices) {
    return choices.stereo > 0 ? "--stereo" : "--quilt";
}

Quilt quilt_of(const QuiltChoices& choices) {
    Quilt quilt;
    quilt.cone = choices.cone.value_or(quilt.cone);
    quilt.focus = choices.focus;
    if (choices.stereo > 0) {
        quilt.columns = 2;
        quilt.rows = 1;
        quilt.separation = choices.stereo;
        return quilt;
    }
    int end = 0;
    const std::string& text = choices.views;
    if (std::sscanf(text.c_str(), "%4d%*1[xX]%4d%n", &quilt.columns, &quilt.rows, &end) != 2 ||
        size_t(end) != text.size() || quilt.columns < 1 || quilt.rows < 1 ||
        quilt.columns * quilt.rows > 1000)
        fail_usage("render: --quilt {}: give COLUMNSxROWS, as in 8x6; at most 1000 views",
                   quote(text));
    return quilt;
}

void refuse_others(const RenderCommand& command) {
    const std::array<std::pair<const char*, bool>, 3> others = {
        {{"--volume", !command.volumes.empty()},
         {"--crop", !command.crop.empty()},
         {"--shard", !command.shard.empty()}}};
    for (const auto& [name, is_given] : others)
        if (is_given)
            fail_usage("render: {}: {} can't be had of {} yet", option_of(command.quilt), name,
                       command.quilt.stereo > 0 ? "stereo pairs" : "a quilt");
    for (const std::string& output : command.outputs)
        if (output.starts_with('-'))
            fail_usage("render: {}: it goes to a file with a name, not to {}",
                       option_of(command.quilt), output);
}

/// The file's name with a suffix that describes the quilt to players.
fs::path named(const fs::path& file, const std::string& suffix) {
    const std::string stem = file.stem().string();
    if (stem.ends_with(suffix)) return file;
    return file.parent_path() / (stem + suffix + file.extension().string());
}

/// What a run does for each of its frames.
struct QuiltRun {
    const Scene& scene;
    const std::vector<Device>& devices;
    const Quilt& quilt;
    const QuiltChoices& choices;
    const ImageFileOptions& files;
};

/// Renders a frame's views and writes them to its files: all side by side or, where a name
/// distinguishes eyes, each to its own file. Returns the files.
std::vector<fs::path> render_views(const QuiltRun& run, const FrameFiles& frame,
                                   const RenderOptions& options, Statistics& statistics) {
    const auto has_eyes = [&](const fs::path& name) {
        return files_of_eyes(name, run.choices).size() > 1;
    };
    std::vector<Image> views;
    std::optional<Image> joined;
    if (std::ranges::any_of(frame.images, has_eyes))
        views = render_views(run.scene, run.devices, run.quilt, frame.frame, options, &statistics);
    else
        joined = render_quilt(run.scene, run.devices, run.quilt, frame.frame, options, &statistics);
    const auto start = std::chrono::steady_clock::now();
    std::vector<fs::path> written;
    for (const fs::path& name : frame.images) {
        const std::vector<fs::path> files = files_of_eyes(name, run.choices);
        if (files.size() == 1 && !joined) joined = join_views(views, run.quilt);
        for (size_t eye = 0; eye < files.size(); ++eye)
            (files.size() == 1 ? *joined : views[eye]).write(files[eye], run.files);
        written.insert(written.end(), files.begin(), files.end());
    }
    statistics.files += written.size();
    statistics.write_seconds += seconds_since(start);
    return written;
}

/// Removes the names of a frame's files that need no rendering.
void skip_finished(const Scene& scene, const Quilt& quilt, const QuiltChoices& choices,
                   const ImageFileOptions& options, Overwrite overwrite, FrameFiles& frame,
                   Finished& finished) {
    std::vector<std::string> views;
    std::string joined;
    if (overwrite == Overwrite::changed) {
        views = view_hashes(scene, quilt, frame.frame);
        joined = quilt_hash(views, quilt);
    }
    const auto is_there = [&](const fs::path& name) {
        const std::vector<fs::path> files = files_of_eyes(name, choices);
        bool all = true;
        for (size_t eye = 0; eye < files.size(); ++eye) {
            const std::string& hash = files.size() == 1 || views.empty() ? joined : views[eye];
            all &= is_finished(files[eye], hash, options, overwrite, finished);
        }
        return all;
    };
    std::erase_if(frame.images, is_there);
    finished.frames += size_t(frame.images.empty());
}

std::string kind_of(const QuiltChoices& choices, size_t frames) {
    const char* kind = choices.stereo > 0 ? "stereo pair" : "quilt";
    return frames == 1 ? kind : fmt::format("{} {}s", frames, kind);
}

void print_plan_of_views(const RenderCommand& command, const Scene& scene, const FrameJob& job,
                         const Quilt& quilt, const LazyDevices& devices) {
    print_plan(scene, devices.selector(),
               {.frames = numbers_of(job.frames),
                .channels = needed_channels(job),
                .quilt = quilt,
                .cache = cache_options(command.scene)},
               {.quiet = command.quiet, .strict = command.scene.strict});
}

RenderOptions render_options(const RenderCommand& command, const FrameJob& job) {
    RenderOptions options;
    options.channels = needed_channels(job);
    options.cache = cache_options(command.scene);
    options.strict = command.scene.strict;
    options.time_kernels = command.verbose || !command.stats.empty();
    return options;
}

}  // namespace

std::vector<fs::path> files_of_eyes(const fs::path& file, const QuiltChoices& choices) {
    if (choices.stereo == 0) return {file};
    std::vector<fs::path> files;
    for (const char* eye : {"left", "right"}) {
        std::string name = file.string();
        for (size_t at = name.find(kEye); at != std::string::npos; at = name.find(kEye))
            name.replace(at, std::string_view(kEye).size(), eye);
        if (name == file) return {file};
        files.emplace_back(name);
    }
    return files;
}

void add_quilt_options(CLI::App& app, QuiltChoices& choices) {
    CLI::Option* quilt =
        app.add_option(
               "--quilt", choices.views,
               "render COLUMNSxROWS views of a light-field display into one image; --size is "
               "that of one view, and _qs8x6a0.75 is added to the file's name")
            ->type_name("COLUMNSxROWS");
    CLI::Option* cone =
        app.add_option(
               "--cone", choices.cone,
               "of a quilt: degrees between its outermost views, as seen from the screen; 40 "
               "by default")
            ->check(in_range(0, 120));
    app.add_option("--stereo", choices.stereo,
                   "the distance of two eyes in metres, like 0.064: render a view for each, side "
                   "by side, the left one first, or into two files whose names have left and "
                   "right in place of {eye}")
        ->check(in_range(1e-6, 1e6))
        ->excludes(quilt)
        ->excludes(cone);
    app.add_option("--focus", choices.focus,
                   "of a quilt or a stereo pair: metres from the observer to what lies in the "
                   "screen; by default what the observer looks at")
        ->check(in_range(1e-6, 1e6));
}

void render_quilts(const RenderCommand& command, const Scene& scene, const FrameJob& job,
                   LazyDevices& devices, const std::string& label,
                   std::chrono::steady_clock::time_point start) {
    refuse_others(command);
    const Quilt quilt = quilt_of(command.quilt);
    if (command.plan_only) return print_plan_of_views(command, scene, job, quilt, devices);
    const Size size = scene.size();
    const std::string suffix =
        command.quilt.stereo > 0 ? "" : quilt_suffix(quilt, size, scene.pixel_aspect());
    RenderProgress progress(label, job.frames.size(), style_of(command));
    const Interruptible interruptible;
    RenderOptions options = render_options(command, job);
    options.stop = interruptible.stop();
    options.compiling = [&](int kernel, int known) { progress.compiling(kernel, known); };
    if (!command.quiet) options.warn = warning_printer(options.strict, [&] { progress.clear(); });
    const auto count = double(job.frames.size());
    double done = 0;
    options.progress = [&](double of_frame, int frame) {
        progress.advance((done + of_frame) / count, frame);
    };
    const Overwrite overwrite = overwrite_of(command);
    Finished finished;
    Statistics statistics;
    std::string written;
    for (FrameFiles frame : job.frames) {
        for (fs::path& file : frame.images) file = named(file, suffix);
        if (overwrite != Overwrite::always)
            skip_finished(scene, quilt, command.quilt, job.image_files, overwrite, frame, finished);
        if (frame.images.empty()) {
            ++done;
            continue;
        }
        if (statistics.frames.empty()) {
            devices.open();
            statistics.open_seconds = seconds_since(start);
        }
        frame.images = render_views({scene, devices.open(), quilt, command.quilt, job.image_files},
                                    frame, options, statistics);
        if (written.empty() && !frame.images.empty()) written = frame.images.front().string();
        progress.written(frame);
        options.warn = {};
        ++done;
    }
    statistics.total_seconds = seconds_since(start);
    progress.clear();
    if (!command.stats.empty()) write_file(command.stats, to_json(statistics));
    if (command.quiet) return;
    progress.tell_of_compiling();
    tell_of(finished, job.frames.size());
    if (statistics.frames.empty()) return;
    tell("{} of {} views of {}x{} in {:.2f} s: {}\n",
         kind_of(command.quilt, job.frames.size() - finished.frames), quilt.columns * quilt.rows,
         size[0], size[1], statistics.total_seconds, written);
    if (command.verbose) print_details(statistics);
}

}  // namespace voxelume::cli
