// SPDX-License-Identifier: Apache-2.0
// Frames rendered for callers, to memory and to files.
#include "runtime/voxelume/render.hpp"

#include <chrono>
#include <mutex>

#include "runtime/api/band_files.hpp"
#include "runtime/api/border/convert.hpp"
#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/api/border/process.hpp"
#include "runtime/api/compiler_watch.hpp"
#include "runtime/api/earlier_images.hpp"
#include "runtime/api/frame_hash.hpp"
#include "runtime/api/image_files.hpp"
#include "runtime/api/render.hpp"
#include "runtime/api/warning.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/base/text.hpp"
#include "runtime/base/version.hpp"
#include "runtime/io/volume_file.hpp"
#include "runtime/render/motion_vectors.hpp"
#include "runtime/render/noise.hpp"
#include "runtime/scene/scene_animation.hpp"

namespace voxelume {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// True for names of formats that hold every channel.
bool holds_channels(const std::filesystem::path& file) {
    const ImageFormatEntry* format = image_format_of(ending_of(file));
    return format != nullptr && format->holds_channels;
}

/// The texts that files of a frame have in their headers.
api::Attributes attributes_of(const Scene& scene, int frame) {
    api::Attributes attributes;
    attributes["scene"] = scene.file.filename().string();
    if (moves(scene)) attributes["frame"] = std::to_string(frame);
    attributes["software"] = "voxelume " + std::string(version());
    return attributes;
}

/// The results that a job asks for in any of its frames.
struct Wanted {
    bool images = false, volumes = false;  ///< in memory or as files
    v1::Channels channels;
};

void add(const v1::Channels& more, v1::Channels& channels) {
    for (const v1::ChannelRow& row : v1::channel_table()) channels.*row.member |= more.*row.member;
}

/// Files for screens and volumetric images show colour, files that hold channels and memory what
/// their options say.
Wanted wanted_by(const v1::FrameJob& job, const v1::RenderOptions& options) {
    Wanted wanted{job.deliver_images, job.deliver_volumes, v1::kNoChannels};
    if (job.deliver_images) add(options.channels, wanted.channels);
    for (const v1::FrameFiles& frame : job.frames) {
        wanted.images |= !frame.images.empty();
        wanted.volumes |= !frame.volumes.empty();
        for (const std::filesystem::path& file : frame.images)
            add(holds_channels(file) ? job.image_files.channels : v1::kColorAlone, wanted.channels);
    }
    if (!wanted.images && !wanted.volumes) add(job.image_files.channels, wanted.channels);
    if (wanted.volumes) add(wanted.images ? v1::kColorAlone : v1::Channels(), wanted.channels);
    return wanted;
}

/// Throws Error::usage for names of files that can't be written, before a frame is rendered.
void check_names(const v1::FrameJob& job) {
    for (const v1::FrameFiles& frame : job.frames) {
        for (const std::filesystem::path& image : frame.images) api::format_of_image(image);
        for (const std::filesystem::path& volume : frame.volumes) volume_format_of(volume);
    }
}

/// A run of frames for a caller.
class Run {
  public:
    Run(const v1::Scene& scene, const std::vector<v1::Device>& devices, const v1::FrameJob& job,
        const v1::RenderOptions& options)
        : scene_(api::inside(scene)),
          assets_(api::assets_of(scene, options.cache)),
          hashes_(scene),
          devices_(api::inside(devices)),
          job_(job),
          options_(options),
          wanted_(wanted_by(job, options)),
          earlier_(scene, job, wanted_.channels) {
        scene_.render.channels = api::inside(wanted_.channels);
        scene_.render.shows_image = wanted_.images || !wanted_.volumes;
        scene_.render.shows_volume = wanted_.volumes;
    }

    v1::Statistics render() {
        const auto start = Clock::now();
        check_names(job_);
        if (wanted_.channels.motion) check_motion(scene_);
        for (const Device& device : devices_) device.time_kernels(options_.time_kernels);
        const CompilerWatch watch(devices_, api::callback(options_.compiling));
        const FrameOutput output = [this](const FrameResult& result) { take(result); };
        const BatchOutcome outcome = render_frames(devices_, scene_, batch_options(), output);
        if (options_.time_kernels)
            for (const Device& device : devices_) device.finish();
        if (outcome.is_cancelled)
            throw v1::Error(v1::ErrorKind::cancelled,
                            fmt::format("cancelled after {} of {} frames", outcome.frames_done,
                                        job_.frames.size()));
        v1::Statistics statistics = api::statistics_of(reports_, devices_);
        statistics.size = api::array_of(scene_.render.size);
        if (wanted_.volumes) statistics.volume_size = api::array_of(scene_.observer.display.voxels);
        statistics.images = wanted_.images;
        statistics.bands = outcome.bands;
        statistics.files = files_;
        statistics.open_seconds = outcome.check_seconds;
        statistics.write_seconds = write_seconds_;
        statistics.one_by_one_from = outcome.one_by_one_from;
        statistics.warnings = std::move(warnings_);
        statistics.total_seconds = seconds_since(start);
        return statistics;
    }

  private:
    BatchOptions batch_options() {
        BatchOptions batch;
        batch.frames.clear();
        for (const v1::FrameFiles& frame : job_.frames) batch.frames.push_back(frame.frame);
        batch.image = wanted_.images;
        batch.volume = wanted_.volumes;
        batch.overlap = options_.overlap;
        batch.meshes = std::move(assets_);
        batch.progress = api::callback(options_.progress);
        batch.is_part = options_.is_part;
        batch.earlier = earlier_.images();
        if (!job_.deliver_images)
            batch.bands = [this](size_t n) { return band_files(job_.frames[n]); };
        batch.warn = [this](std::span<const Warning> warnings) { tell(warnings); };
        batch.stop = options_.stop;
        return batch;
    }

    void tell(std::span<const Warning> found) {
        const std::vector<v1::Warning> warnings = api::warnings_for_callers(found);
        for (const v1::Warning& warning : warnings) {
            warnings_.push_back(warning);
            if (options_.warn) api::callback(options_.warn)(warning);
        }
        if (!options_.strict) return;
        const std::string more =
            found.size() > 1 ? fmt::format(" (the first of {} warnings)", found.size()) : "";
        throw Error(found[0].where, ErrorKind::scene,
                    fmt::format("{}: {}{}", found[0].where, found[0].text, more));
    }

    /// The texts for an image's files, without the noise while bands are missing.
    api::Attributes texts_of_image(int frame, const NoiseReached* noise) {
        api::Attributes texts = attributes_of(scene_, frame);
        if (!noise && measures_noise(scene_)) texts["noise"] = api::noise_text({});
        if (noise && noise->tiles > 0) texts["noise"] = api::noise_text(*noise);
        texts.merge(api::sampling_texts(scene_));
        if (scene_.render.pixel_aspect != 1)
            texts[kPixelAspect] = fmt::format("{}", scene_.render.pixel_aspect);
        if (scene_.render.transparent) texts[api::kTransparent] = "true";
        texts[api::kFrameHash] = hashes_.of(frame);
        return texts;
    }

    /// The sink that writes a frame's image in bands.
    std::shared_ptr<BandSink> band_files(const v1::FrameFiles& files) {
        const RenderSettings& render = scene_.render;
        const std::lock_guard lock(hashes_mutex_);
        return std::make_shared<api::BandFiles>(
            ImageWindow{render.size, render.crop.first, render.crop.frame},
            texts_of_image(files.frame, nullptr), files, job_.image_files,
            [this, frame = files.frame](const auto& band) { return with_motion(band, frame); });
    }

    void take(const FrameResult& result) {
        const v1::FrameFiles& files = job_.frames[reports_.size()];
        reports_.push_back(result.report);
        v1::RenderedFrame rendered{files.frame, {}, {}, api::statistics_of(result.report)};
        if (result.image)
            rendered.image =
                api::handle_of(with_motion(result.image, files.frame),
                               texts_of_image(files.frame, &result.report.report.noise));
        if (result.bands)
            write_seconds_ += static_cast<const api::BandFiles&>(*result.bands).seconds();
        if (result.volume) {
            api::Attributes all = result.volume->attributes;
            for (const auto& [name, text] : attributes_of(scene_, files.frame)) all[name] = text;
            const NoiseReached& noise = result.report.report.volume_noise;
            if (noise.tiles > 0) all["noise"] = api::noise_text(noise);
            all[api::kStamp] = stamp_of(hashes_.of_volume(files.frame));
            rendered.volume = api::handle_of(result.volume, std::move(all));
        }
        write(rendered, files);
        if (!job_.deliver_images) rendered.image.reset();
        if (!job_.deliver_volumes) rendered.volume.reset();
        if (job_.deliver) api::callback(job_.deliver)(rendered);
    }

    /// The image with its motion where that is asked for, without what only the motion needed.
    std::shared_ptr<const Image> with_motion(const std::shared_ptr<const Image>& image,
                                             int frame) const {
        const v1::Channels& channels = wanted_.channels;
        if (!channels.motion) return image;
        const auto moving = std::make_shared<Image>(*image);
        add_motion(scene_, frame, *moving);
        if (!channels.object) moving->id_planes.erase("objectId");
        for (const char* plane : {"P.X", "P.Y", "P.Z"})
            if (!channels.position) moving->planes.erase(plane);
        return moving;
    }

    void write(const v1::RenderedFrame& rendered, const v1::FrameFiles& files) {
        const auto start = Clock::now();
        if (rendered.image)
            for (const std::filesystem::path& file : files.images)
                rendered.image->write(file, job_.image_files);
        for (const std::filesystem::path& file : files.volumes) rendered.volume->write(file);
        files_ += files.images.size() + files.volumes.size();
        write_seconds_ += seconds_since(start);
    }

    Scene scene_;
    AssetStore assets_;
    api::FrameHashes hashes_;
    std::mutex hashes_mutex_;
    std::vector<Device> devices_;
    const v1::FrameJob& job_;
    const v1::RenderOptions& options_;
    Wanted wanted_;
    api::EarlierFiles earlier_;
    std::vector<FrameReport> reports_;
    std::vector<v1::Warning> warnings_;
    size_t files_ = 0;
    double write_seconds_ = 0;
};

void check_job(const v1::FrameJob& job) {
    if (job.frames.empty()) throw Error(ErrorKind::usage, "no frame is given to render");
    for (const v1::FrameFiles& frame : job.frames)
        if (frame.images.empty() && frame.volumes.empty() && !job.deliver_images &&
            !job.deliver_volumes)
            throw Error(ErrorKind::usage,
                        "frame {} is to be neither written nor delivered: name a file, or set "
                        "deliver_images or deliver_volumes",
                        frame.frame);
}

}  // namespace

namespace v1 {

Channels needed_channels(const FrameJob& job, const RenderOptions& options) {
    return wanted_by(job, options).channels;
}

Statistics render_frames(const Scene& scene, const std::vector<Device>& devices,
                         const FrameJob& job, const RenderOptions& options) {
    return api::guarded([&] {
        api::apply_process_options();
        check_job(job);
        return Run(scene, devices, job, options).render();
    });
}

Image render_image(const Scene& scene, const std::vector<Device>& devices, int frame,
                   const RenderOptions& options, Statistics* statistics) {
    std::optional<Image> image;
    const auto take = [&image](const RenderedFrame& rendered) { image = rendered.image; };
    const FrameJob job{.frames = {{.frame = frame}}, .deliver = take, .deliver_images = true};
    Statistics of_run = render_frames(scene, devices, job, options);
    if (statistics) *statistics = std::move(of_run);
    return *image;
}

Volume render_volume(const Scene& scene, const std::vector<Device>& devices, int frame,
                     const RenderOptions& options, Statistics* statistics) {
    std::optional<Volume> volume;
    const auto take = [&volume](const RenderedFrame& rendered) { volume = rendered.volume; };
    const FrameJob job{.frames = {{.frame = frame}}, .deliver = take, .deliver_volumes = true};
    Statistics of_run = render_frames(scene, devices, job, options);
    if (statistics) *statistics = std::move(of_run);
    return *volume;
}

}  // namespace v1
}  // namespace voxelume
