// SPDX-License-Identifier: Apache-2.0
// Physically based surfaces by the formulas of the literature, in double precision: GGX's facets,
// Smith's shadowing, Schlick's reflectance, Kulla and Conty's later light. Albedos are sums over
// facets.
#pragma once

#include <glm/vec3.hpp>
#include <map>

namespace voxelume::oracle {

struct PhysicalValues {
    double metallic = 0, roughness = 0.5, ior = 1.5;
    glm::dvec3 base{1};
};

/// The unit vector whose angle with z has this cosine.
glm::dvec3 at_cosine(double cosine, double turn = 0);

/// The albedo of facets of this reflectance, over the normals of all facets, seen or not.
double facet_albedo(double cosine, double alpha, double reflectance);

class PhysicalFormulas {
  public:
    explicit PhysicalFormulas(const PhysicalValues& surface);

    /// pi times the reflectance distribution between two directions, times the cosine of the
    /// second.
    double value(const glm::dvec3& out, const glm::dvec3& in, int channel);

  private:
    double albedo(double cosine, double reflectance);
    double later(double f0) const;
    double passed(double cosine);

    PhysicalValues s_;
    double alpha_, f0_, all_ = 0, plain_ = 0;
    std::map<std::pair<double, double>, double> known_;
};

}  // namespace voxelume::oracle
