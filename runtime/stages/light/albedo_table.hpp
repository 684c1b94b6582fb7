// SPDX-License-Identifier: Apache-2.0
// width of highlights -> how much light a rough surface returns at once, by the angle.
#pragma once

#include <array>

#include "kernels/shared/scene.h"

namespace voxelume {

/// The table of kernels/shared/scene.h for one width.
struct AlbedoTable {
    std::array<float, VXL_ALBEDO_ENTRIES * VXL_ALBEDO_FLOATS> values{};
    double missing = 0, by_angle = 0;  ///< means over all directions, by their cosine
};

/// GGX's alpha of a roughness. Highlights are at least so wide that floats hold them.
double width_of(double roughness);

/// The table of highlights of a width, from 1/1024 to 1, within 5e-4. It takes about 40 ms,
/// but for widths that the process has asked for before. Any thread may call it.
AlbedoTable albedo_table(double width);

/// The share of light that facets reflect several times and return, per share that they don't
/// return at once: `reflectance` is what one reflects straight on (Kulla & Conty 2017).
double multiple_share(double reflectance, double missing);

/// The share of light that gets through to what lies under the facets, over all directions.
double passed_share(double reflectance, const AlbedoTable& table);

}  // namespace voxelume
