// SPDX-License-Identifier: Apache-2.0
// width of highlights -> how much light a rough surface returns at once, by the angle.
#pragma once

#include <array>
#include <span>

#include "kernels/shared/scene.h"

namespace voxelume {

inline constexpr int kLastAlbedo = VXL_ALBEDO_ENTRIES - 1;  ///< the last entry of a table

/// Means over all directions, weighted by their cosine, in shares of the light that reaches facets:
/// what they don't return at once, and what they return at once of the part (1 - m)^5.
struct AlbedoMeans {
    double missing = 0, by_angle = 0, entered = 1;
};

/// The table of kernels/shared/scene.h for one width.
struct AlbedoTable : AlbedoMeans {
    std::array<float, VXL_ALBEDO_ENTRIES * VXL_ALBEDO_FLOATS> values{};
};

/// The light that facets return at once at an angle.
struct FacetAlbedo {
    double all = 0, by_angle = 0;
};

/// The value that kernels read from a table.
FacetAlbedo read_albedo(const AlbedoTable& table, double width, double cosine);

/// One of the `rows` numbers of each entry, interpolated at an index from 0 to kLastAlbedo.
double between_entries(std::span<const float> values, int rows, int row, double at);

/// GGX's alpha of a roughness, limited from below so that floats can hold highlights.
double width_of(double roughness);

/// The table of highlights of a width, from 1/1024 to 1, within 5e-4. It takes about 40 ms, except
/// for widths that the process has asked for before. Any thread may call it.
AlbedoTable albedo_table(double width);

/// The share of light that facets return after several reflections, per share that they don't
/// return at once. The facets reflect `reflectance` straight on and `grazing` along the surface
/// (Kulla & Conty 2017).
double multiple_share(double reflectance, double missing, double grazing = 1);

/// The share of light that reaches what lies under the facets, over all directions.
double passed_share(double reflectance, const AlbedoMeans& means, double grazing = 1);

}  // namespace voxelume
