// SPDX-License-Identifier: Apache-2.0
// Physically based surfaces by the formulas of the literature, in double precision: GGX's facets,
// Smith's shadowing, Schlick's reflectance, and Kulla and Conty's model of later light, under a
// coat with the same models. Albedos are sums over facets.
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <vector>

namespace voxelume::oracle {

struct PhysicalValues {
    double metallic = 0, roughness = 0.5, ior = 1.5;
    glm::dvec3 base{1};
    double specular = 1, coat = 0, coat_roughness = 0.3;
};

/// The unit vector whose angle with z has this cosine.
glm::dvec3 at_cosine(double cosine, double turn = 0);

/// The albedo of facets of this reflectance, over the normals of all facets, seen or not.
double facet_albedo(double cosine, double alpha, double reflectance);

/// The light that a coat of index 1.5 returns.
class CoatFormulas {
  public:
    explicit CoatFormulas(double alpha);
    double returned(double cosine) const;

    /// The value of this coat, in the units of PhysicalFormulas::value.
    double value(const glm::dvec3& out, const glm::dvec3& in) const;

  private:
    struct Entry {
        double all, once;
    };
    Entry at(double cosine) const;

    double alpha_, missing_ = 0, later_;
    std::vector<Entry> entries_;
};

class PhysicalFormulas {
  public:
    explicit PhysicalFormulas(const PhysicalValues& surface);

    /// pi times the reflectance distribution between two directions, times the cosine of the
    /// second.
    double value(const glm::dvec3& out, const glm::dvec3& in, int channel);

  private:
    double albedo(double cosine, double reflectance, double grazing);
    double later(double f0, double grazing) const;
    double entered(double cosine) const;
    double missing(double cosine);
    double passed(double cosine);

    PhysicalValues s_;
    CoatFormulas coat_;
    double alpha_, f0_, all_ = 0, plain_ = 0, entered_ = 0;
    std::map<std::pair<double, double>, double> known_;
};

}  // namespace voxelume::oracle
