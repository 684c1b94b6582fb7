// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/tile_share.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace voxelume {

void add_tile(uint32_t tile, std::vector<TileRange>& ranges) {
    if (!ranges.empty() && ranges.back().first + ranges.back().count == tile)
        ++ranges.back().count;
    else
        ranges.push_back({tile, 1});
}

double count_tiles(const std::vector<TileRange>& tiles) {
    double sum = 0;
    for (const TileRange& range : tiles) sum += range.count;
    return sum;
}

std::vector<TileRange> take_sixteenth(std::vector<TileRange>& tiles) {
    const auto wanted = uint32_t(std::ceil(count_tiles(tiles) / 16));
    std::vector<TileRange> first, rest;
    uint32_t taken = 0;
    for_each_tile(tiles, [&](uint32_t tile) { add_tile(tile, taken++ < wanted ? first : rest); });
    tiles = std::move(rest);
    return first;
}

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
