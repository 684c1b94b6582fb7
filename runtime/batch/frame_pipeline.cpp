#include "runtime/batch/frame_pipeline.hpp"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "runtime/base/closing.hpp"
#include "runtime/base/error.hpp"
#include "runtime/batch/device_frames.hpp"
#include "runtime/batch/frame_worker.hpp"

namespace voxelume {
namespace {

/// Hands values from one thread to another, one at a time and in order.
template <class T>
class Handoff {
  public:
    /// Waits until the value before was taken. False when no more are wanted.
    bool put(T value) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return closed_ || !value_; });
        if (closed_) return false;
        value_.emplace(std::move(value));
        changed_.notify_all();
        return true;
    }
    /// Waits until the other thread works on the value. False when no more are wanted.
    bool wait_until_taken() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return closed_ || !value_; });
        return !closed_;
    }
    /// The next value; nothing after the last one.
    std::optional<T> take() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return closed_ || value_; });
        std::optional<T> taken = std::exchange(value_, std::nullopt);
        changed_.notify_all();
        return taken;
    }
    /// No value follows, or none is wanted. The last one can still be taken.
    void close() {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        changed_.notify_all();
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<T> value_;
    bool closed_ = false;
};

struct BuiltFrame {
    Scene scene;
    BuiltWorld world;
    WorldReport report;
    std::exception_ptr error;  ///< instead of all that
};

BuiltFrame build_next(WorldBuilder& builder, const FrameSteps& steps, size_t frame) {
    BuiltFrame built;
    built.scene = steps.scene(frame);
    built.world = build_frame(builder, steps, frame, built.scene, built.report);
    return built;
}

/// The frames from `first` on.
void run_one_by_one(const Device& device, size_t first, size_t count, const FrameSteps& steps,
                    AssetStore meshes) {
    FrameWorker worker(device, 0, steps, std::move(meshes), count - first > 1);
    for (size_t frame = first; frame < count; ++frame) {
        const Scene scene = steps.scene(frame);
        worker.take(frame, scene)();
    }
}

bool is_limit(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const Error& limit) {
        return limit.kind() == ErrorKind::limit;
    } catch (...) {
        return false;
    }
}

/// A thread that is waited for.
class Worker {
  public:
    template <class Work>
    explicit Worker(Work work) : thread_(std::move(work)) {}
    ~Worker() { thread_.join(); }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

  private:
    std::thread thread_;
};

/// Returns how many frames were rendered: fewer than all where memory doesn't suffice for two.
size_t run_overlapped(const Device& device, size_t count, const FrameSteps& steps,
                      AssetStore meshes) {
    Handoff<BuiltFrame> built;
    Handoff<std::function<void()>> writes;
    std::exception_ptr write_error, error;
    size_t frame = 0;
    try {
        const Worker writer([&] {
            const Closing closing(writes);
            try {
                while (const auto write = writes.take()) (*write)();
            } catch (...) {
                write_error = std::current_exception();
            }
        });
        const Closing end_writes(writes);
        const Worker forming([&] {
            const Closing closing(built);
            try {
                WorldBuilder builder(device.with_own_queue(), true, std::move(meshes));
                for (size_t next = 0; next < count; ++next) {
                    // Two worlds at a time: the next is begun when this one is being rendered.
                    if (!built.put(build_next(builder, steps, next))) return;
                    if (!built.wait_until_taken()) return;
                }
            } catch (...) {
                BuiltFrame failed;
                failed.error = std::current_exception();
                built.put(std::move(failed));
            }
        });
        const Closing end_building(built);
        for (; frame < count; ++frame) {
            std::optional<BuiltFrame> next = built.take();
            if (!next) break;
            if (next->error) std::rethrow_exception(next->error);
            if (!writes.put(steps.render({frame, 0, next->scene, next->world, next->report})))
                break;
        }
    } catch (...) {
        error = std::current_exception();
    }
    // The writer's frame comes before all others.
    if (write_error) std::rethrow_exception(write_error);
    if (error && (!steps.forget || !is_limit(error))) std::rethrow_exception(error);
    return frame;
}

}  // namespace

std::optional<size_t> run_frames(const std::vector<Device>& devices, size_t count,
                                 const FrameSteps& steps, FrameOptions options) {
    if (devices.size() > 1 && count > 1) {
        share_frames(devices, count, steps, options.meshes);
        return std::nullopt;
    }
    if (!options.overlap || count < 2) {
        run_one_by_one(devices[0], 0, count, steps, std::move(options.meshes));
        return std::nullopt;
    }
    const ModelCache cache = options.meshes.cache();
    const size_t first = run_overlapped(devices[0], count, steps, std::move(options.meshes));
    if (first == count) return std::nullopt;
    steps.forget(0);
    run_one_by_one(devices[0], first, count, steps, AssetStore(cache));
    return first;
}

}  // namespace voxelume
