// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/solid_extents.hpp"

#include <algorithm>

namespace voxelume {

SurfaceExtent SolidExtents::of(const Model& model, double edge,
                               const std::function<SurfaceExtent()>& count) {
    const auto known = std::ranges::find_if(
        known_, [&](const Known& k) { return k.edge == edge && k.model == model; });
    if (known != known_.end()) return known->extent;
    // Without a limit, moving models would add ever more entries.
    constexpr size_t kMaxKnown = 1024;
    if (known_.size() == kMaxKnown) known_.clear();
    known_.push_back({model, edge, count()});
    return known_.back().extent;
}

}  // namespace voxelume
