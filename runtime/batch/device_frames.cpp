#include "runtime/batch/device_frames.hpp"

#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "runtime/base/closing.hpp"
#include "runtime/batch/frame_worker.hpp"

namespace voxelume {
namespace {

struct RenderedFrame {
    std::function<void()> write;
    std::exception_ptr error;  ///< instead
};

/// Frames on their way from the devices' threads to the one that writes them.
class FrameShare {
  public:
    FrameShare(size_t count, size_t ahead) : count_(count), ahead_(ahead) {}

    /// The next frame to render, once it isn't too far ahead; nothing when no more are wanted.
    std::optional<size_t> take() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock,
                      [&] { return closed_ || next_ == count_ || next_ < written_ + ahead_; });
        if (closed_ || next_ == count_) return std::nullopt;
        return next_++;
    }
    void put(size_t frame, RenderedFrame rendered) {
        const std::lock_guard lock(mutex_);
        if (rendered.error) count_ = next_;  // what comes later isn't written
        rendered_.emplace(frame, std::move(rendered));
        changed_.notify_all();
    }
    /// Waits for a frame that was taken or will be.
    RenderedFrame wait_for(size_t frame) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return rendered_.contains(frame); });
        RenderedFrame rendered = std::move(rendered_.at(frame));
        rendered_.erase(frame);
        return rendered;
    }
    void count_written() {
        const std::lock_guard lock(mutex_);
        ++written_;
        changed_.notify_all();
    }
    /// No more frames are wanted.
    void close() {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        changed_.notify_all();
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<size_t, RenderedFrame> rendered_;
    size_t count_, ahead_, next_ = 0, written_ = 0;
    bool closed_ = false;
};

}  // namespace

void share_frames(const std::vector<Device>& devices, size_t count, const FrameSteps& steps,
                  const AssetStore& meshes) {
    FrameShare share(count, 2 * devices.size());
    std::mutex scenes;
    const auto work = [&](size_t device) {
        std::optional<FrameWorker> worker;
        while (const std::optional<size_t> frame = share.take()) {
            RenderedFrame rendered;
            try {
                // What was read to check the frames counts once.
                if (!worker)
                    worker.emplace(devices[device], device, steps,
                                   device == 0 ? meshes : meshes.recounted(), true);
                Scene scene;
                {
                    const std::lock_guard lock(scenes);
                    scene = steps.scene(*frame);
                }
                rendered.write = worker->take(*frame, scene);
            } catch (...) {
                rendered.error = std::current_exception();
            }
            share.put(*frame, std::move(rendered));
        }
    };
    std::vector<std::jthread> threads;
    const Closing closing(share);  // before the threads are waited for
    for (size_t device = 0; device < devices.size(); ++device)
        threads.emplace_back([&work, device] { work(device); });
    for (size_t frame = 0; frame < count; ++frame) {
        const RenderedFrame rendered = share.wait_for(frame);
        if (rendered.error) std::rethrow_exception(rendered.error);
        rendered.write();
        share.count_written();
    }
}

}  // namespace voxelume
