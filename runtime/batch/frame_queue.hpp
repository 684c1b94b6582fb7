// SPDX-License-Identifier: Apache-2.0
// Frames on their way from the devices that render them to the thread that outputs them, in order.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <utility>

namespace voxelume {

/// Hands a rendered frame over.
using OutputStep = std::function<void()>;

/// The result of a device for a frame.
struct RenderedFrame {
    OutputStep output;
    std::exception_ptr error;  ///< thrown instead of an output
    bool is_limit = false;     ///< the error is one of memory, or another limit
};

/// Frames 0 to `count` - 1, of which at most `ahead` are taken and not output yet.
class FrameQueue {
  public:
    FrameQueue(size_t count, size_t ahead) : count_(count), ahead_(ahead) {}

    /// The next frame to render, once it is not too far ahead; nothing when no more are wanted.
    std::optional<size_t> take() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, closed(), [&] { return next_ >= count_ || next_ < output_ + ahead_; });
        if (is_closed() || next_ >= count_) return std::nullopt;
        return next_++;
    }
    /// Gives back a frame that was taken. After an error no more are wanted.
    void put(size_t frame, RenderedFrame rendered) {
        const std::lock_guard lock(mutex_);
        if (rendered.error) count_ = next_;
        rendered_.emplace(frame, std::move(rendered));
        changed_.notify_all();
    }
    /// Gives `frame` and the later frames to their one device again, each once all frames before it
    /// are output.
    void restart(size_t frame) {
        const std::lock_guard lock(mutex_);
        next_ = frame;
        ahead_ = 1;
    }
    /// Waits for the next frame in order and hands it over; nothing when the queue is closed.
    std::optional<RenderedFrame> wait_for_next() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, closed(), [&] { return rendered_.contains(output_); });
        if (is_closed()) return std::nullopt;
        return std::move(rendered_.extract(output_).mapped());
    }
    /// Notes that the frame that was taken last is output.
    void count_output() {
        const std::lock_guard lock(mutex_);
        ++output_;
        changed_.notify_all();
    }
    /// Closes the queue: no more frames are wanted, not even those that are being rendered.
    void close() { closed_.request_stop(); }
    bool is_closed() const { return closed_.stop_requested(); }
    std::stop_token closed() const { return closed_.get_token(); }

  private:
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::stop_source closed_;
    std::map<size_t, RenderedFrame> rendered_;
    size_t count_, ahead_, next_ = 0, output_ = 0;
};

}  // namespace voxelume
