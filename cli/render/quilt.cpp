// SPDX-License-Identifier: Apache-2.0
#include "cli/render/quilt.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <filesystem>
#include <utility>

#include "cli/render/frame_files.hpp"
#include "cli/render/render_progress.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/interrupt.hpp"
#include "cli/shared/tell.hpp"
#include "cli/shared/warnings.hpp"

namespace voxelume::cli {
namespace {

Quilt quilt_of(const QuiltChoices& choices) {
    Quilt quilt;
    int end = 0;
    const std::string& text = choices.views;
    if (std::sscanf(text.c_str(), "%4d%*1[xX]%4d%n", &quilt.columns, &quilt.rows, &end) != 2 ||
        size_t(end) != text.size() || quilt.columns < 1 || quilt.rows < 1 ||
        quilt.columns * quilt.rows > 1000)
        fail_usage("render: --quilt {}: give COLUMNSxROWS, as in 8x6; at most 1000 views",
                   quote(text));
    quilt.cone = choices.cone;
    quilt.focus = choices.focus;
    return quilt;
}

void refuse_others(const RenderCommand& command) {
    const std::array<std::pair<const char*, bool>, 9> others = {
        {{"--volume", !command.volumes.empty()},
         {"--crop", !command.crop.empty()},
         {"--shard", !command.shard.empty()},
         {"--noise", command.scene.noise > 0},
         {"--time", command.scene.time > 0},
         {"--stats-json", !command.stats.empty()},
         {"--overwrite", !command.overwrite.empty() && command.overwrite != "always"},
         {"--resume", command.resume},
         {"--dry-run", command.plan_only}}};
    for (const auto& [name, is_given] : others)
        if (is_given) fail_usage("render: --quilt: {} can't be had of a quilt yet", name);
    for (const std::string& output : command.outputs)
        if (output.starts_with('-'))
            fail_usage("render: --quilt: a quilt needs a name that says what is in it, not {}",
                       output);
}

/// The file's name with what tells players of the quilt.
std::filesystem::path named(const std::filesystem::path& file, const std::string& suffix) {
    const std::string stem = file.stem().string();
    if (stem.ends_with(suffix)) return file;
    return file.parent_path() / (stem + suffix + file.extension().string());
}

}  // namespace

void add_quilt_options(CLI::App& app, QuiltChoices& choices) {
    app.add_option("--quilt", choices.views,
                   "render COLUMNSxROWS views of a light-field display into one image; --size is "
                   "that of one view, and _qs8x6a0.75 is added to the file's name")
        ->type_name("COLUMNSxROWS");
    app.add_option("--cone", choices.cone,
                   "of a quilt: degrees between its outermost views, as seen from the screen; 40 "
                   "by default")
        ->check(in_range(0, 120));
    app.add_option("--focus", choices.focus,
                   "of a quilt: metres from the observer to what lies in the screen; by default "
                   "what the observer looks at")
        ->check(in_range(1e-6, 1e6));
}

void render_quilts(const RenderCommand& command, const Scene& scene, const FrameJob& job,
                   const std::vector<Device>& devices, const std::string& label) {
    refuse_others(command);
    const Quilt quilt = quilt_of(command.quilt);
    const Size size = scene.size();
    const std::string suffix = quilt_suffix(quilt, size);
    const auto start = std::chrono::steady_clock::now();
    const ProgressStyle style = progress_style(command.progress);
    RenderProgress progress(
        label, job.frames.size(),
        command.quiet && style == ProgressStyle::automatic ? ProgressStyle::none : style);
    const Interruptible interruptible;
    RenderOptions options;
    options.channels = needed_channels(job);
    options.cache = cache_options(command.scene);
    options.stop = interruptible.stop();
    options.strict = command.scene.strict;
    options.compiling = [&](int kernel, int known) { progress.compiling(kernel, known); };
    if (!command.quiet) options.warn = warning_printer(options.strict, [&] { progress.clear(); });
    const auto count = double(job.frames.size());
    double done = 0;
    options.progress = [&](double of_frame, int frame) {
        progress.advance((done + of_frame) / count, frame);
    };
    for (FrameFiles frame : job.frames) {
        const Image image = render_quilt(scene, devices, quilt, frame.frame, options);
        for (std::filesystem::path& file : frame.images) {
            file = named(file, suffix);
            image.write(file, job.image_files);
        }
        progress.written(frame);
        options.warn = {};
        ++done;
    }
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    progress.clear();
    if (!command.quiet)
        tell("{} of {} views of {}x{} in {:.2f} s: {}\n",
             job.frames.size() == 1 ? "quilt" : fmt::format("{} quilts", job.frames.size()),
             quilt.columns * quilt.rows, size[0], size[1], passed.count(),
             job.frames.front().images.empty()
                 ? ""
                 : named(job.frames.front().images.front(), suffix).string());
}

}  // namespace voxelume::cli
