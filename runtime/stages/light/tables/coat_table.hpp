// SPDX-License-Identifier: Apache-2.0
// widths of a coat's highlights and of those below -> the light that the coat takes from the
// latter.
#pragma once

#include <array>

#include "kernels/shared/scene.h"
#include "runtime/stages/light/tables/albedo_table.hpp"

namespace voxelume {

/// The table of kernels/shared/scene.h, and means over all directions, weighted by their cosine,
/// for a coat on the whole surface.
struct CoatTable {
    std::array<float, VXL_ALBEDO_ENTRIES * 2> values{};
    double returned = 0;                   ///< share that the coat returns
    double taken = 0, taken_by_angle = 0;  ///< shares of the light that facets below return at once
};

/// The share that a coat returns at an angle; its facets have this table and width.
double coat_returned(const AlbedoTable& table, double width, double cosine);

/// The part of the light that a coat's facets return later, of the light that they don't return at
/// once.
double coat_later(const AlbedoTable& table);

/// The table of a coat over facets of a width, both as width_of has them. It takes about 60 ms,
/// except for tables that the process has asked for before. Any thread may call it.
CoatTable coat_table(double coat_width, double width);

/// The means of facets below a coat that covers a share of the surface.
AlbedoMeans means_under_coat(const AlbedoMeans& facets, const CoatTable& coat, double share);

}  // namespace voxelume
