// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/tile_share.hpp"

#include <algorithm>

namespace voxelume {

std::optional<TileRange> TileShare::take(uint32_t count) {
    const std::lock_guard lock(mutex_);
    if (is_closed()) return std::nullopt;
    if (!ranges_.empty()) {
        TileRange& next = ranges_.front();
        const TileRange range{next.first, std::min({count, maximum_, next.count})};
        next = {next.first + range.count, next.count - range.count};
        if (next.count == 0) ranges_.erase(ranges_.begin());
        return range;
    }
    if (whole_ || next_ >= tiles_) return std::nullopt;
    const TileRange range{next_, std::min({count, maximum_, tiles_ - next_})};
    next_ += range.count;
    return range;
}

void TileShare::give_back(const TileRange& range) {
    const std::lock_guard lock(mutex_);
    ranges_.insert(ranges_.begin(), range);
}

void TileShare::add_work(double tiles) {
    if (whole_) return whole_->add_work(tiles);
    constexpr double kRounding = 1e-6;  // rounding of sums of weights
    const std::lock_guard lock(mutex_);
    done_ += tiles;
    if (progress_) progress_(std::min(uint32_t(done_ + kRounding * tiles_), tiles_), tiles_);
}

}  // namespace voxelume
