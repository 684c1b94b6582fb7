// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/tile_share.hpp"

#include <algorithm>

namespace voxelume {

std::optional<TileRange> TileShare::take(uint32_t count) {
    const std::lock_guard lock(mutex_);
    if (is_closed_ || next_ >= tiles_) return std::nullopt;
    const TileRange range{next_, std::min({count, maximum_, tiles_ - next_})};
    next_ += range.count;
    return range;
}

void TileShare::done(const TileRange& range) {
    const std::lock_guard lock(mutex_);
    done_ += range.count;
    if (progress_) progress_(done_, tiles_);
}

}  // namespace voxelume
