// SPDX-License-Identifier: Apache-2.0
// width of highlights and index of refraction -> the share of light that rough glass doesn't return
// at once.
#pragma once

#include <array>

#include "kernels/shared/scene.h"

namespace voxelume {

/// The numbers of kernels/shared/scene.h for one width and index. In pairs, the outside comes
/// first.
struct GlassTable {
    std::array<float, VXL_GLASS_ENTRIES * 2> values{};  ///< missing shares by the angle
    std::array<double, 2> missing{};                    ///< their means, by the cosine
    std::array<double, 2> back{};  ///< the part of what is missing that comes back later
};

/// The table of facets of a width, from 1/1024 to 1, between media of this index of refraction,
/// which isn't 1. It takes about 0.6 s, except for tables that the process has asked for before.
/// Any thread may call it.
GlassTable glass_table(double width, double ior);

}  // namespace voxelume
