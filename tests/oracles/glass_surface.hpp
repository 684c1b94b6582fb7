// SPDX-License-Identifier: Apache-2.0
// Rough glass by the formulas of Walter et al. 2007, in double precision: facets with GGX's
// distribution that reflect and refract by Fresnel's law. Albedos are sums over all facets.
#pragma once

#include <glm/vec3.hpp>
#include <map>

namespace voxelume::oracle {

class GlassFormulas {
  public:
    /// The glass seen from a side with index of refraction `here`; the other side has `behind`.
    GlassFormulas(double alpha, double here, double behind)
        : alpha_(alpha), here_(here), behind_(behind) {}

    /// pi times the distribution of the light that facets return at once between two directions,
    /// times the cosine of the second direction, which is above the surface or behind it. Radiance
    /// isn't scaled by the square of the index.
    double at_once(const glm::dvec3& out, const glm::dvec3& in) const;

    /// The share of light at an angle that facets don't return at once, and its mean weighted by
    /// the cosine.
    double missing(double cosine);
    double mean_missing();

  private:
    double reflected(double cosine) const;
    double hidden(double height) const;

    double alpha_, here_, behind_, mean_ = -1;
    std::map<double, double> known_;
};

}  // namespace voxelume::oracle
