// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/physical_surface.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace voxelume::oracle {
namespace {

constexpr double kPi = std::numbers::pi;

double tan2_of(const glm::dvec3& v) {
    return (v.x * v.x + v.y * v.y) / (v.z * v.z);
}

double lambda_of(const glm::dvec3& v, double alpha) {
    return (std::sqrt(1 + alpha * alpha * tan2_of(v)) - 1) / 2;
}

double ggx_of(const glm::dvec3& h, double alpha) {
    const double a2 = alpha * alpha, t = 1 + tan2_of(h) / a2;
    return 1 / (kPi * a2 * std::pow(h.z, 4) * t * t);
}

double facets_between(const glm::dvec3& o, const glm::dvec3& i, double alpha) {
    const glm::dvec3 h = glm::normalize(o + i);
    return ggx_of(h, alpha) / (1 + lambda_of(o, alpha) + lambda_of(i, alpha)) / (4 * o.z * i.z);
}

double schlick(double reflectance, double cosine) {
    return reflectance + (1 - reflectance) * std::pow(1 - cosine, 5);
}

}  // namespace

glm::dvec3 at_cosine(double cosine, double turn) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(turn), sine * std::sin(turn), cosine};
}

double facet_albedo(double cosine, double alpha, double reflectance) {
    constexpr int kParts = 300;
    const glm::dvec3 o = at_cosine(cosine);
    double sum = 0;
    for (int k = 0; k < kParts; ++k) {
        // Shares of the facets' area, finer where they stand up.
        const double rest = std::pow(1 - (k + 0.5) / kParts, 3);
        const double tangent = alpha * std::sqrt((1 - rest * rest) / (rest * rest));
        for (int j = 0; j < kParts; ++j) {
            const glm::dvec3 h =
                at_cosine(1 / std::sqrt(1 + tangent * tangent), kPi * (j + 0.5) / kParts);
            const double meets = glm::dot(o, h);
            const glm::dvec3 i = 2 * meets * h - o;
            if (meets <= 0 || i.z <= 0) continue;
            const double seen =
                meets / (o.z * h.z) / (1 + lambda_of(o, alpha) + lambda_of(i, alpha));
            // A facet's share falls by the sixth power of what is left of the parts.
            sum += seen * schlick(reflectance, meets) * 6 * std::pow(1 - (k + 0.5) / kParts, 5) /
                   (kParts * kParts);
        }
    }
    return sum;
}

PhysicalFormulas::PhysicalFormulas(const PhysicalValues& surface)
    : s_(surface),
      alpha_(surface.roughness * surface.roughness),
      f0_(std::pow((surface.ior - 1) / (surface.ior + 1), 2)) {
    // Gauss and Legendre's six points for means over the square of the cosine.
    constexpr double kAt[] = {0.0337652429, 0.1693953068, 0.3806904070};
    constexpr double kShare[] = {0.0856622462, 0.1803807865, 0.2339569673};
    for (int k = 0; k < 3; ++k)
        for (const double square : {kAt[k], 1 - kAt[k]}) {
            all_ += kShare[k] * facet_albedo(std::sqrt(square), alpha_, 1);
            plain_ += kShare[k] * facet_albedo(std::sqrt(square), alpha_, f0_);
        }
}

double PhysicalFormulas::albedo(double cosine, double reflectance) {
    const auto [found, is_new] = known_.try_emplace({cosine, reflectance});
    if (is_new) found->second = facet_albedo(cosine, alpha_, reflectance);
    return found->second;
}

double PhysicalFormulas::later(double f0) const {
    const double mean = f0 + (1 - f0) / 21;
    return mean * mean * all_ / (1 - mean * (1 - all_));
}

double PhysicalFormulas::passed(double cosine) {
    return 1 - albedo(cosine, f0_) - later(f0_) * (1 - albedo(cosine, 1));
}

double PhysicalFormulas::value(const glm::dvec3& out, const glm::dvec3& in, int channel) {
    const double met = glm::dot(glm::normalize(out + in), in), base = s_.base[channel];
    const double missing = (1 - albedo(out.z, 1)) * (1 - albedo(in.z, 1));
    const double at_once = facets_between(out, in, alpha_);
    const auto metal = [&](double f0) {
        return at_once * schlick(f0, met) + later(f0) * missing / (1 - all_) / kPi;
    };
    const double mean_passed = 1 - plain_ - later(f0_) * (1 - all_);
    const double matt = base / kPi * passed(out.z) * passed(in.z) / mean_passed;
    return kPi * in.z * (s_.metallic * metal(base) + (1 - s_.metallic) * (metal(f0_) + matt));
}

}  // namespace voxelume::oracle
