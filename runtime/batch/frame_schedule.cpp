// SPDX-License-Identifier: Apache-2.0
#include "runtime/batch/frame_schedule.hpp"

#include <algorithm>
#include <deque>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/batch/frame_queue.hpp"
#include "runtime/scene/scene_animation.hpp"

namespace voxelume {
namespace {

/// The way in which each device takes its frames.
enum class Mode {
    one_each,    ///< only the frame that has the device's index
    one_by_one,  ///< one after another
    overlapped   ///< the device builds the next frame's world, on a queue of its own, while one is
                 ///< rendered
};

/// The state that the devices of a run share.
struct Run {
    const FrameSteps& steps;
    Mode mode;
    size_t count;  ///< number of frames
    FrameQueue queue;
    std::mutex scenes = {};                      ///< held while a scene is made
    std::optional<size_t> one_by_one_from = {};  ///< as in the outcome

    bool retains() const { return (mode != Mode::one_each && count > 1) || steps.moment; }
};

/// Adds the time and work of building another world, and its warnings, to `sum`.
void add_build(const WorldReport& report, WorldReport& sum) {
    sum.load_seconds += report.load_seconds;
    sum.voxelize_seconds += report.voxelize_seconds;
    sum.place_seconds += report.place_seconds;
    sum.index_seconds += report.index_seconds;
    sum.keep_seconds += report.keep_seconds;
    sum.meshes_read += report.meshes_read;
    sum.voxelized += report.voxelized;
    sum.from_cache += report.from_cache;
    sum.painted_bricks += report.painted_bricks;
    sum.change = std::max(sum.change, report.change);
    if (report.change == WorldChange::built) sum.is_from_cache &= report.is_from_cache;
    sum.lacks_room |= report.lacks_room;
    sum.instances.indexed += report.instances.indexed;
    sum.instances.moved += report.instances.moved;
    sum.instances.seconds += report.instances.seconds;
    for (const Warning& warning : report.warnings) add_once(warning, sum.warnings);
}

/// A frame whose world is built.
struct BuiltFrame {
    Scene scene;
    Scene shown = {};  ///< with moments: the scene whose world it has
    BuiltWorld world;
    WorldReport report;
    bool has_moments = false;
};

/// Takes frames from the queue for one device, and gives them back rendered.
class Lane {
  public:
    /// `index` is the device's in the run.
    Lane(const Device& device, size_t index, Run& run, AssetStore meshes)
        : device_(device),
          index_(index),
          run_(run),
          cache_(meshes.cache()),
          builder_(std::in_place, run.mode == Mode::overlapped ? device.with_own_queue() : device,
                   run.retains(), std::move(meshes)),
          retains_(run.retains()) {}

    /// Returns when there are no more frames for the device.
    void run() {
        if (run_.mode == Mode::one_each) return render_alone(index_);
        if (run_.mode == Mode::overlapped) overlap();
        while (const std::optional<size_t> frame = run_.queue.take()) render_alone(*frame);
    }

  private:
    void render_alone(size_t frame) {
        run_.queue.put(frame, attempt(frame, [&] { return build_and_render(frame); }));
    }

    /// Keeps two worlds at a time: the next one is begun when this one is being rendered. Ends with
    /// the first frame for which memory doesn't suffice for that.
    void overlap() {
        const auto build_next = [this]() -> std::optional<BuiltFrame> {
            const std::optional<size_t> frame = run_.queue.take();
            return frame ? std::optional(build(*frame)) : std::nullopt;
        };
        auto next = std::async(std::launch::deferred, build_next);
        for (size_t frame = 0; frame < run_.count; ++frame) {
            RenderedFrame rendered = attempt(frame, [&] {
                std::optional<BuiltFrame> built = next.get();
                if (!built) return OutputStep();  // the queue is closed
                next = std::async(std::launch::async, build_next);
                return render(frame, std::move(*built));
            });
            if (run_.queue.is_closed()) return;
            if (rendered.is_limit && run_.steps.forget) {
                next = {};  // waits for it, and frees its world
                forget(run_.count - frame > 1);
                run_.one_by_one_from = frame;
                return run_.queue.restart(frame);
            }
            const bool has_failed = rendered.error != nullptr;
            run_.queue.put(frame, std::move(rendered));
            if (has_failed) return;
        }
    }

    /// Calls the action that leads to a frame's output. An error is kept, with the frame's number,
    /// until the frame's turn.
    template <class Action>
    RenderedFrame attempt(size_t frame, const Action& action) {
        const FrameSteps& steps = run_.steps;
        RenderedFrame rendered;
        try {
            rendered.output = action();
        } catch (const Error& error) {
            rendered.is_limit = error.kind() == ErrorKind::limit;
            rendered.error = steps.number
                                 ? std::make_exception_ptr(at_frame(error, steps.number(frame)))
                                 : std::current_exception();
        } catch (...) {
            rendered.error = std::current_exception();
        }
        if (rendered.error && steps.failed) steps.failed();
        return rendered;
    }

    /// Builds and renders a frame. If the device has no memory for it in addition to what is
    /// retained of earlier frames, the latter is forgotten, now and from then on.
    OutputStep build_and_render(size_t frame) {
        if (has_any_ && !retains_) forget(false);
        try {
            return render(frame, build(frame));
        } catch (const Error& error) {
            const bool makes_room = retains_ && (has_any_ || builder_->keeps());
            if (error.kind() != ErrorKind::limit || !makes_room || !run_.steps.forget) throw;
        }
        lacks_room_ = true;
        forget(false);
        return render(frame, build(frame));
    }

    BuiltFrame build(size_t frame) {
        const FrameSteps& steps = run_.steps;
        BuiltFrame built;
        {
            const std::lock_guard lock(run_.scenes);
            built.scene = steps.scene(frame);
            built.has_moments = steps.has_moments && steps.has_moments(frame);
        }
        if (built.has_moments) {
            built.world = moment_world(built.scene, built.report);
            built.shown = built.scene;
        } else {
            built.world =
                builder_->build(built.scene, built.report,
                                steps.retained ? steps.retained(frame) : std::vector<bool>());
        }
        built.report.lacks_room |= lacks_room_;
        return built;
    }

    OutputStep render(size_t frame, BuiltFrame built) {
        const Moments moments = moments_of(frame, built);
        OutputStep output =
            run_.steps.render({frame, index_, built.scene, built.world, built.report,
                               built.has_moments ? &moments : nullptr, run_.queue.closed()});
        has_any_ = true;
        return output;
    }

    /// The moments of a frame, whose worlds replace each other.
    Moments moments_of(size_t frame, BuiltFrame& built) {
        const auto scene = [this, frame](int sample) {
            const std::lock_guard lock(run_.scenes);
            return run_.steps.moment(frame, sample);
        };
        const auto world = [this, &built](Scene now) -> const BuiltWorld& {
            now.render = built.scene.render;
            if (now == built.shown) return built.world;
            WorldReport report;
            built.world = {};
            built.world = moment_world(now, report);
            add_build(report, built.report);
            built.shown = std::move(now);
            return built.world;
        };
        return {scene, world};
    }

    /// Builds the world of a moment. Without memory for what is retained of earlier moments, that
    /// is forgotten.
    BuiltWorld moment_world(const Scene& now, WorldReport& report) {
        const std::vector<bool> all(now.models.size(), true);
        try {
            BuiltWorld world = builder_->build(now, report, all);
            has_built_ = true;
            return world;
        } catch (const Error& error) {
            const bool makes_room = retains_ && (has_built_ || builder_->keeps());
            if (error.kind() != ErrorKind::limit || !makes_room) throw;
        }
        lacks_room_ = true;
        retains_ = false;
        builder_.emplace(device_, false, AssetStore(cache_));
        report = {};
        BuiltWorld world = builder_->build(now, report, all);
        report.lacks_room = true;
        return world;
    }

    void forget(bool retains) {
        builder_.emplace(device_, retains, AssetStore(cache_));
        run_.steps.forget(index_);
        retains_ = retains;
        has_any_ = false;
    }

    Device device_;
    size_t index_;
    Run& run_;
    ModelCache cache_;
    std::optional<WorldBuilder> builder_;
    bool retains_;             ///< frames may retain something for later frames
    bool lacks_room_ = false;  ///< memory doesn't suffice for retaining anything
    bool has_any_ = false;     ///< something of earlier frames is retained
    bool has_built_ = false;   ///< the world of a moment is built
};

/// Threads that end, and are waited for, when the run does.
struct LaneThreads {
    FrameQueue& queue;
    std::vector<std::jthread> threads = {};
    ~LaneThreads() { queue.close(); }
};

Mode mode_of(size_t devices, const ScheduleOptions& options) {
    if (options.one_each) return Mode::one_each;
    return devices == 1 && options.overlap ? Mode::overlapped : Mode::one_by_one;
}

/// The maximum number of frames in progress. Where one device overlaps frames, one frame's world is
/// built, one frame is rendered, one waits, and one is output.
size_t frames_ahead(Mode mode, size_t devices) {
    if (mode == Mode::overlapped) return 4;
    return devices == 1 ? 1 : 2 * devices;
}

}  // namespace

ScheduleOutcome run_frames(const std::vector<Device>& devices, size_t count,
                           const FrameSteps& steps, ScheduleOptions options) {
    const size_t used = std::min(devices.size(), count);
    if (steps.moment) options.overlap = false;  // overlapping needs the builder for the next frame
    const Mode mode = count > 1 ? mode_of(used, options) : Mode::one_by_one;
    Run run{steps, mode, count, FrameQueue(count, frames_ahead(mode, used))};
    const std::stop_callback cancel(options.stop, [&run] { run.queue.close(); });
    std::deque<Lane> lanes;
    for (size_t i = used; i-- > 0;)  // what was read before counts once, for the first device
        lanes.emplace_front(devices[i], i, run,
                            i > 0 ? options.meshes.recounted() : std::move(options.meshes));
    ScheduleOutcome outcome;
    {
        LaneThreads running{run.queue};
        for (Lane& lane : lanes) running.threads.emplace_back([&lane] { lane.run(); });
        for (; outcome.frames_done < count; ++outcome.frames_done) {
            const std::optional<RenderedFrame> rendered = run.queue.wait_for_next();
            if (!rendered) break;
            if (rendered->error) std::rethrow_exception(rendered->error);
            rendered->output();
            run.queue.count_output();
        }
    }
    outcome.one_by_one_from = run.one_by_one_from;
    return outcome;
}

}  // namespace voxelume
