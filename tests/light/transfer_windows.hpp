// SPDX-License-Identifier: Apache-2.0
// A transfer function with two windows, and its values, computed independently.
#pragma once

#include <vector>

#include "runtime/scene/parts/world.hpp"

namespace voxelume {

/// Two windows: one for soft materials, one for hard ones, and nothing between them.
inline const std::vector<TransferPoint> kWindows = {
    {-2, 0, {0, 0, 1}}, {-1, 2, {1, 0.5F, 0.25F}},   {0.5, 0.5F, {0, 1, 0}},  {1.25, 0, {0, 0, 0}},
    {3, 0, {1, 1, 1}},  {3.5, 8, {0.5F, 1, 0.125F}}, {6, 4, {0.25F, 0.5F, 1}}};

/// The absorption, or absorption times a colour, at a value, interpolated between its neighbours.
inline double light_at(double value, int channel) {
    const auto of = [&](const TransferPoint& p) {
        return channel < 3 ? p.absorption * double(p.color[channel]) : p.absorption;
    };
    if (value <= kWindows.front().value) return of(kWindows.front());
    for (size_t i = 1; i < kWindows.size(); ++i) {
        const TransferPoint &a = kWindows[i - 1], &b = kWindows[i];
        if (value > b.value) continue;
        const double share = (value - a.value) / (b.value - a.value);
        return of(a) * (1 - share) + of(b) * share;
    }
    return of(kWindows.back());
}

}  // namespace voxelume
