// SPDX-License-Identifier: Apache-2.0
// The tiles of an image, shared among the devices that render it.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

namespace voxelume {

/// A callback with the number of finished parts of a frame, and of all its parts. One thread at a
/// time calls it.
using FrameProgress = std::function<void(uint32_t done, uint32_t total)>;

/// Consecutive tiles of 4 x 4 pixels, numbered along the image's rows.
struct TileRange {
    uint32_t first = 0;
    uint32_t count = 0;
};

/// Adds a tile to ascending ranges.
void add_tile(uint32_t tile, std::vector<TileRange>& ranges);

/// The number of tiles in ranges.
double count_tiles(const std::vector<TileRange>& tiles);

/// Takes the first sixteenth of some tiles from them, rounded up.
std::vector<TileRange> take_sixteenth(std::vector<TileRange>& tiles);

template <class See>
void for_each_tile(const std::vector<TileRange>& tiles, See&& see) {
    for (const TileRange& range : tiles)
        for (uint32_t tile = range.first; tile < range.first + range.count; ++tile) see(tile);
}

/// The tiles for which a predicate holds.
template <class IsTrue>
std::vector<TileRange> tiles_where(const std::vector<TileRange>& tiles, IsTrue&& is_true) {
    std::vector<TileRange> result;
    for_each_tile(tiles, [&](uint32_t tile) {
        if (is_true(tile)) add_tile(tile, result);
    });
    return result;
}

/// Hands out an image's tiles, in order, to several threads.
class TileShare {
  public:
    /// Hands out `tiles` tiles, at most `maximum` at a time.
    explicit TileShare(uint32_t tiles, FrameProgress progress = {}, uint32_t maximum = UINT32_MAX)
        : tiles_(tiles), maximum_(maximum), progress_(std::move(progress)) {}

    /// Hands out these tiles of another share; closing the other share closes this one, too. Their
    /// work is reported to the whole's callback times `weight`.
    TileShare(TileShare& whole, std::vector<TileRange> ranges, double weight)
        : tiles_(whole.tiles_),
          maximum_(UINT32_MAX),
          weight_(weight),
          whole_(&whole),
          ranges_(std::move(ranges)) {}

    /// Hands out tiles of its own as a part of another share's work; closing the other share closes
    /// this one, too. Each tile counts as `weight` tiles of the whole.
    TileShare(TileShare& whole, uint32_t tiles, double weight)
        : tiles_(tiles),
          maximum_(UINT32_MAX),
          weight_(weight),
          whole_(&whole),
          ranges_({{0, tiles}}) {}

    /// The next tiles, at most `count`; empty if all were handed out.
    std::optional<TileRange> take(uint32_t count);
    /// Hands out tiles again that were taken and not rendered.
    void give_back(const TileRange& range);
    /// Reports to the progress callback that these tiles are done, with the weight of their work.
    void done(const TileRange& range) { add_work(range.count * weight_); }
    /// Reports that work is done or not needed: 1 is a tile with all of its weights.
    void add_work(double tiles);
    double weight() const { return weight_; }  ///< weight of a tile's work
    /// Sets that the share's own tiles are only `weight` of the work.
    void set_weight(double weight) { weight_ = weight; }
    /// Ends the work: no more tiles are handed out.
    void close() { is_closed_ = true; }
    bool is_closed() const { return is_closed_ || (whole_ && whole_->is_closed()); }

    uint32_t tiles() const { return tiles_; }
    uint32_t maximum() const { return std::min(maximum_, tiles_); }  ///< maximum at a time
    /// True if progress is observed or tiles are shared.
    bool is_watched() const {
        return progress_ || maximum_ < tiles_ || (whole_ && whole_->is_watched());
    }

  private:
    std::mutex mutex_;
    uint32_t tiles_;
    uint32_t maximum_;
    uint32_t next_ = 0;
    std::atomic<double> weight_ = 1;  ///< weight of a tile's work
    double done_ = 0;                 ///< tiles
    FrameProgress progress_;
    TileShare* whole_ = nullptr;
    std::vector<TileRange> ranges_;  ///< what is left of another share, and what was given back
    std::atomic<bool> is_closed_ = false;
};

/// Tiles of a share, which go back to it unless they are done.
class TakenTiles {
  public:
    TakenTiles(TileShare& share, const TileRange& range) : share_(share), range_(range) {}
    ~TakenTiles() {
        if (!are_done_) share_.give_back(range_);
    }
    TakenTiles(const TakenTiles&) = delete;
    TakenTiles& operator=(const TakenTiles&) = delete;

    void set_done() { are_done_ = true; }

  private:
    TileShare& share_;
    TileRange range_;
    bool are_done_ = false;
};

}  // namespace voxelume
