// SPDX-License-Identifier: Apache-2.0
// One job of `render`: renders a scene to its files.
#include "cli/render/render_job.hpp"

#include <chrono>
#include <optional>

#include "cli/output/channels.hpp"
#include "cli/output/crop.hpp"
#include "cli/output/output_stream.hpp"
#include "cli/output/view_transforms.hpp"
#include "cli/render/finished_files.hpp"
#include "cli/render/render_progress.hpp"
#include "cli/render/render_report.hpp"
#include "cli/render/shard_part.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/interrupt.hpp"
#include "cli/shared/tell.hpp"
#include "cli/shared/warnings.hpp"

namespace voxelume::cli {
namespace {

/// The scene, reduced to the part of the image that --crop names.
Scene cropped(const Scene& scene, const std::string& text) {
    const ImagePart part = part_of(text, scene);
    return scene.with_crop(part.first, part.size);
}

/// Removes finished frames from the job, and reports them. Returns whether any frames are left.
bool remove_finished(const Scene& scene, const RenderCommand& command, FrameJob& job) {
    const size_t count = job.frames.size();
    if (count == 0 && !command.quiet)
        tell("this part has nothing to render: there are more parts than frames or rows\n");
    const std::vector<int> numbers = numbers_of(job.frames);
    const Finished finished =
        skip_finished(scene, job.image_files, overwrite_of(command), job.frames);
    if (job.frames.empty() && OutputStream(command.outputs).is_wanted()) {
        job.frames.push_back({numbers.front(), {}, {}});  // the stream still gets its image
        return true;
    }
    if (!command.quiet) tell_of(finished, count);
    return !job.frames.empty();
}

/// The files of a run, or of a part of it.
struct RunFiles {
    FrameJob job;
    std::string label;  ///< label of the progress
    bool is_part = false;
};

/// Renders the files of a run, and shows the progress.
Statistics render_files(const Scene& scene, const std::vector<Device>& devices, RunFiles run,
                        const RenderCommand& command) {
    FrameJob& job = run.job;
    RenderProgress progress(run.label, job.frames.size(), style_of(command));
    const Interruptible interruptible;
    RenderOptions render;
    render.stop = interruptible.stop();
    render.cache = cache_options(command.scene);
    render.overlap = !command.one_by_one;
    render.time_kernels = command.verbose || !command.stats.empty();
    render.progress = [&](double done, int frame) { progress.advance(done, frame); };
    render.compiling = [&](int kernel, int known) { progress.compiling(kernel, known); };
    render.strict = command.scene.strict;
    render.is_part = run.is_part;
    if (!command.quiet) render.warn = warning_printer(render.strict, [&] { progress.clear(); });
    const OutputStream stream(command.outputs);
    if (stream.is_wanted()) {
        job.deliver_images = true;
        render.channels = stream.channels(job.image_files);
    }
    job.deliver = [&, files = job.frames.begin()](const RenderedFrame& frame) mutable {
        if (stream.is_wanted()) stream.write(*frame.image, job.image_files);
        progress.written(*files++);
    };
    Statistics statistics = render_frames(scene, devices, job, render);
    progress.clear();
    if (!command.quiet) progress.tell_of_compiling();
    return statistics;
}

}  // namespace

ProgressStyle style_of(const RenderCommand& command) {
    const ProgressStyle style = progress_style(command.progress);
    return command.quiet && style == ProgressStyle::automatic ? ProgressStyle::none : style;
}

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
    job.image_files = {command.exposure,
                       parse_view_transform(command.view_transform, "render: --view-transform"),
                       command.png_bits,
                       command.float_color,
                       parse_channels(command.channels, "render: --channels"),
                       command.multi_part};
    Scene scene = read_with(command.scene, "render");
    job.frames = frame_files(command, scene);
    check_files(job.frames, scene, command);
    if (command.quilt.is_asked_for())
        return render_quilts(command, scene, job, lazy_devices, label, start);
    if (!command.crop.empty() && command.outputs.empty() && !command.volumes.empty())
        fail_usage("render: --crop is of images, and no -o names one; --volume is whole anyway");
    if (!command.crop.empty()) scene = cropped(scene, command.crop);
    std::optional<ShardPart> part;
    if (!command.shard.empty()) part.emplace(command, scene, job);
    const size_t frames = job.frames.size();
    if (!command.plan_only && !remove_finished(scene, command, job)) {
        if (part) part->write();
        Statistics statistics;
        statistics.total_seconds = seconds();
        if (!command.stats.empty()) write_file(command.stats, to_json(statistics));
        return;
    }
    if (command.plan_only) {
        print_plan(scene, lazy_devices.selector(),
                   {.frames = numbers_of(job.frames),
                    .channels = needed_channels(job),
                    .image = !command.outputs.empty(),
                    .volume = !command.volumes.empty(),
                    .cache = cache_options(command.scene)},
                   {.quiet = command.quiet,
                    .strict = command.scene.strict,
                    .tells_volume = command.outputs.empty() && command.volumes.empty()});
        return;
    }
    const std::vector<Device>& devices = lazy_devices.open();
    if (!command.quiet && scene.has_default_light())
        tell("note: {}\n",
             harmless_line(fmt::format("{}: has no \"lights\", so one shines from the "
                                       "observer's upper left; \"lights\": [] is dark",
                                       scene.file().string())));
    const double open_seconds = seconds();
    const bool is_part = part.has_value() || job.frames.size() < frames;
    Statistics statistics = render_files(scene, devices, {std::move(job), label, is_part}, command);
    statistics.open_seconds += open_seconds;
    if (part) part->write();
    statistics.total_seconds = seconds();
    if (!command.stats.empty()) write_file(command.stats, to_json(statistics));
    if (command.quiet) return;
    print_summary(statistics);
    if (command.scene.noise > 0 && command.scene.time > 0 && !statistics.rays.noise &&
        !statistics.rays.volume_noise)
        tell(
            "note: the noise isn't known, since there was no time for more than the first 16 "
            "samples: give --time more seconds\n");
    if (command.verbose) print_details(statistics);
}

}  // namespace voxelume::cli
