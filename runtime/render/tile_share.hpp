// One image's tiles, shared out among the devices that render it.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

namespace voxelume {

/// Called with the parts of a frame that are done, and their number; by one thread at a time.
using FrameProgress = std::function<void(uint32_t done, uint32_t total)>;

/// Tiles of 4 x 4 pixels that follow each other, numbered along the image's rows.
struct TileRange {
    uint32_t first = 0;
    uint32_t count = 0;
};

/// Gives an image's tiles, in order, to those who ask.
class TileShare {
  public:
    /// At most `maximum` tiles at a time.
    explicit TileShare(uint32_t tiles, FrameProgress progress = {}, uint32_t maximum = UINT32_MAX)
        : tiles_(tiles), maximum_(maximum), progress_(std::move(progress)) {}

    /// The next tiles, `count` or fewer; nothing when all are given away.
    std::optional<TileRange> take(uint32_t count);
    /// Tells the progress that they are done.
    void done(const TileRange& range);
    /// Ends the work of all who ask.
    void close() { is_closed_ = true; }

    uint32_t tiles() const { return tiles_; }
    uint32_t maximum() const { return std::min(maximum_, tiles_); }  ///< at a time
    /// Whether someone waits to hear what is done, or for the tiles that are left.
    bool is_watched() const { return progress_ || maximum_ < tiles_; }

  private:
    std::mutex mutex_;
    uint32_t tiles_;
    uint32_t maximum_;
    uint32_t next_ = 0;
    uint32_t done_ = 0;
    FrameProgress progress_;
    std::atomic<bool> is_closed_ = false;
};

}  // namespace voxelume
