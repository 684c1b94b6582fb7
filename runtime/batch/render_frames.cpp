// SPDX-License-Identifier: Apache-2.0
#include "runtime/batch/render_frames.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>

#include "runtime/analysis/culling.hpp"
#include "runtime/analysis/model_last_uses.hpp"
#include "runtime/analysis/scene_choices.hpp"
#include "runtime/analysis/warnings/scene_warnings.hpp"
#include "runtime/base/error.hpp"
#include "runtime/batch/frame_scenes.hpp"
#include "runtime/batch/frame_schedule.hpp"
#include "runtime/batch/image_parts.hpp"
#include "runtime/batch/run_warnings.hpp"
#include "runtime/memory/frame_plans.hpp"
#include "runtime/memory/image_bands.hpp"
#include "runtime/render/smaller_batches.hpp"
#include "runtime/render/volume_renderer.hpp"
#include "runtime/scene/first_samples.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kPartsPerDevice = 16;  // so that no device waits long for the last one
constexpr double kSteps = 1 << 20;        // of a frame's progress: their sums are exact

/// Thrown to leave a frame that is not wanted any more; no caller sees it.
struct Cancelled {};

[[noreturn]] void refuse_not_finite(uint32_t count) {
    throw Error(ErrorKind::render,
                "{} values of the image were not finite and became 0: please report this scene",
                count);
}

/// Renders on one device, and retains what later frames show again.
struct DeviceRenderers {
    Renderer image;
    VolumeRenderer volume;
};

class Batch {
  public:
    Batch(const std::vector<Device>& devices, Scene scene, BatchOptions options,
          const FrameOutput& output)
        : devices_(devices),
          scene_(std::move(scene)),
          options_(std::move(options)),
          output_(output),
          done_(options_.frames.size()) {}

    BatchOutcome run() {
        const auto start = std::chrono::steady_clock::now();
        check();
        const std::chrono::duration<double> checked = std::chrono::steady_clock::now() - start;
        // The pixels of an adaptive image depend on their neighbours, which others would render.
        const bool shares_image = devices_.size() > 1 && options_.frames.size() == 1 &&
                                  !options_.volume &&
                                  !(bands_.are_one() && is_adaptive(scene_.render));
        BatchOutcome outcome = !shares_image      ? run_whole_frames()
                               : bands_.are_one() ? run_image_parts()
                                                  : run_image_bands();
        outcome.bands = bands_.count;
        outcome.is_cancelled = outcome.frames_done < options_.frames.size();
        if (options_.warn && !outcome.is_cancelled)
            warnings_->end(scene_, options_.frames, options_.is_part);
        outcome.check_seconds = checked.count();
        return outcome;
    }

  private:
    void check() {
        make_choices(scene_, options_.meshes);
        if (options_.warn)
            warnings_.emplace(scene_warnings(scene_, options_.frames, options_.meshes),
                              options_.meshes.cache(), options_.warn);
        find_potentially_visible(scene_, options_.frames, options_.meshes);
        if (options_.image) choose_bands();
        if (options_.frames.size() == 1) return;  // it is planned when its world is built
        const Scene planned = band_of(scene_, bands_, 0);
        for (const Device& device : devices_)
            check_frames(planned, options_.frames, options_.meshes, device.info());
    }

    /// Decides whether images are rendered in bands, which have to suit all devices.
    void choose_bands() {
        for (const Device& device : devices_) {
            const ImageBands bands = bands_that_fit(scene_, options_.frames, options_.meshes,
                                                    device.info(), int(devices_.size()));
            if (bands.are_one()) continue;
            if (const std::optional<NeedOfWhole> need = need_of_whole()) {
                if (bands.are_needed) refuse_bands(scene_, device.info(), *need);
                continue;
            }
            if (bands.count > bands_.count) bands_ = bands;
        }
    }

    std::optional<NeedOfWhole> need_of_whole() const {
        if (options_.earlier)
            return NeedOfWhole{"samples are added to whole images",
                               "render it again from the start"};
        if (!options_.bands)
            return NeedOfWhole{"only files are written in bands", "write it to a file"};
        return voxelume::need_of_whole(scene_.render);
    }

    FrameSteps steps_of(std::vector<int> frames) const {
        return steps_that_show({scene_, bands_, options_.earlier}, std::move(frames));
    }

    ScheduleOptions schedule(bool one_each) {
        return {options_.overlap, one_each, std::move(options_.meshes), options_.stop};
    }

    BatchOutcome run_whole_frames() {
        const size_t count = options_.frames.size();
        std::vector<DeviceRenderers> renderers;
        renderers.reserve(devices_.size());
        for (const Device& device : devices_)
            renderers.push_back({Renderer(device, count > 1), VolumeRenderer(device, count > 1)});
        FrameSteps steps = steps_of(options_.frames);
        steps.render = [&](const FrameInput& input) {
            return output_of(input.frame, rendered(renderers[input.device], input));
        };
        steps.forget = [&](size_t device) {
            renderers[device] = {Renderer(devices_[device]), VolumeRenderer(devices_[device])};
        };
        if (count > 1)
            steps.retained = [until = last_uses(scene_, options_.frames)](size_t n) {
                std::vector<bool> retained(until.size());
                for (size_t i = 0; i < until.size(); ++i) retained[i] = until[i] > n + 1;
                return retained;
            };
        const ScheduleOutcome ran = run_frames(devices_, count, steps, schedule(false));
        BatchOutcome outcome;
        outcome.frames_done = ran.frames_done;
        if (ran.one_by_one_from) outcome.one_by_one_from = options_.frames[*ran.one_by_one_from];
        return outcome;
    }

    FrameResult rendered(DeviceRenderers& renderers, const FrameInput& input) {
        if (input.stop.stop_requested()) throw Cancelled();
        FrameResult result;
        result.report = {options_.frames[input.frame], input.device, {}};
        RenderReport& report = result.report.report;
        report.world = input.report;
        const int pictures = int(options_.image) + int(options_.volume);
        const auto progress_after = [&](int before) -> FrameProgress {
            return [&, before](uint32_t done, uint32_t total) {
                if (input.stop.stop_requested()) throw Cancelled();
                advance(input.frame, (before + double(done) / total) / pictures);
            };
        };
        if (options_.image && bands_.are_one()) {
            renderers.image.set_moments(input.moments);
            result.image =
                renderers.image.image(input.scene, input.world, report, progress_after(0));
        } else if (options_.image) {
            result.bands = options_.bands(input.frame);
            BandedImage image(bands_, scene_.render, *result.bands, progress_after(0));
            image.render(devices_[input.device], input.scene, input.world, report, input.moments);
            result.shown = image.shown();
        }
        // A volumetric image shows the frame itself.
        if (options_.volume && input.moments) input.moments->world(input.scene);
        report.world = input.report;
        if (options_.volume)
            result.volume = renderers.volume.volume(input.scene, input.world, report,
                                                    progress_after(int(options_.image)));
        return result;
    }

    /// Renders the only frame on all devices.
    BatchOutcome run_image_parts() {
        const size_t count = devices_.size();
        const uint32_t tiles = tile_count(scene_.render.size.x, scene_.render.size.y);
        const auto tell = [&](uint32_t done, uint32_t) { advance(0, double(done) / tiles); };
        TileShare share(tiles, tell, std::max(tiles / (kPartsPerDevice * uint32_t(count)), 1u));
        std::vector<ImagePart> parts(count);
        FrameSteps steps = steps_of(std::vector(count, options_.frames[0]));
        steps.render = [&](const FrameInput& input) -> OutputStep {
            const std::stop_callback cancel(input.stop, [&] { share.close(); });
            ImagePart& part = parts[input.device];
            Renderer renderer(devices_[input.device], false);
            renderer.set_moments(input.moments);
            part.image = with_batches_that_fit(
                devices_[input.device], [&] { return !part.tiles.empty(); },
                [&] {
                    part.report = {};
                    return renderer.part_of_image(input.scene, input.world, part.report,
                                                  {share, part.tiles});
                });
            part.report.world = input.report;
            return [] {};
        };
        steps.failed = [&] { share.close(); };
        if (run_frames(devices_, count, steps, schedule(true)).frames_done < count) return {};
        FrameResult result;
        result.report.frame = options_.frames[0];
        result.image =
            std::make_shared<const Image>(join_parts(std::move(parts), result.report.report));
        output_of(0, std::move(result))();
        BatchOutcome outcome;
        outcome.frames_done = 1;
        return outcome;
    }

    /// Renders the only frame in bands, which all devices take in turn.
    BatchOutcome run_image_bands() {
        const size_t count = devices_.size();
        const std::stop_token stop = options_.stop;
        FrameResult result;
        result.report.frame = options_.frames[0];
        result.bands = options_.bands(0);
        const auto tell = [&](uint32_t done, uint32_t total) {
            if (stop.stop_requested()) throw Cancelled();
            advance(0, double(done) / total);
        };
        BandedImage image(bands_, scene_.render, *result.bands, tell);
        std::vector<RenderReport> reports(count);
        FrameSteps steps = steps_of(std::vector(count, options_.frames[0]));
        steps.render = [&](const FrameInput& input) -> OutputStep {
            const std::stop_callback cancel(input.stop, [&] { image.close(); });
            RenderReport& report = reports[input.device];
            image.render(devices_[input.device], input.scene, input.world, report, input.moments);
            report.world = input.report;
            return [] {};
        };
        steps.failed = [&] { image.close(); };
        if (run_frames(devices_, count, steps, schedule(true)).frames_done < count) return {};
        for (const RenderReport& report : reports) add_report(report, result.report.report);
        result.shown = image.shown();
        output_of(0, std::move(result))();
        BatchOutcome outcome;
        outcome.frames_done = 1;
        return outcome;
    }

    /// Tells that `part` of a frame is done. It is less than before where the frame is begun again.
    void advance(size_t n, double part) {
        const std::lock_guard lock(progress_mutex_);
        const auto steps = uint64_t(part * kSteps);
        if (!options_.progress || steps <= done_[n]) return;
        sum_ += steps - std::exchange(done_[n], steps);
        try {
            options_.progress(double(sum_) / (kSteps * double(done_.size())), options_.frames[n]);
        } catch (...) {
            options_.progress = nullptr;  // other devices may end tiles before they are stopped
            throw;
        }
    }

    OutputStep output_of(size_t n, FrameResult result) {
        const uint32_t not_finite = result.report.report.not_finite;
        if (not_finite != 0) refuse_not_finite(not_finite);
        advance(n, 1);
        return [this, result = std::move(result)] {
            if (warnings_) warnings_->add(result);
            if (result.bands) result.bands->finish(result.report.report);
            output_(result);
        };
    }

    const std::vector<Device>& devices_;
    Scene scene_;
    BatchOptions options_;
    const FrameOutput& output_;
    ImageBands bands_;
    std::mutex progress_mutex_;
    std::vector<uint64_t> done_;  ///< the part of each frame that is done, of kSteps
    uint64_t sum_ = 0;            ///< sum of these parts
    std::optional<RunWarnings> warnings_;
};

}  // namespace

BatchOutcome render_frames(const std::vector<Device>& devices, Scene scene, BatchOptions options,
                           const FrameOutput& output) {
    return Batch(devices, std::move(scene), std::move(options), output).run();
}

}  // namespace voxelume
