// SPDX-License-Identifier: Apache-2.0
// The facets of a rough surface that are visible from a direction.
#pragma once

#include <functional>

namespace voxelume {

inline double squared(double x) {
    return x * x;
}

/// Facets that look one way.
struct SeenFacet {
    double seen = 0;   ///< share of these unhidden facets in all that is visible
    double out = 0;    ///< cosine of the direction in which they mirror light
    double meets = 0;  ///< cosine of the angle at which they meet it
};

/// Calls `add` with the facets of a GGX surface of this width, seen from a direction with this
/// cosine, that mirror it upwards. The sum of their `seen` is the surface's albedo if they reflect
/// all light.
void for_each_facet(double cosine, double width, const std::function<void(const SeenFacet&)>& add);

/// Calls `add` with cosines, and with the share of uniform light that comes at each.
void for_each_cosine(const std::function<void(double share, double cosine)>& add);

}  // namespace voxelume
