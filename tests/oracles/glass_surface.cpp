// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/glass_surface.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace voxelume::oracle {

/// Fresnel's reflectance from Snell's angles.
double GlassFormulas::reflected(double cosine) const {
    const double angle = std::acos(std::min(cosine, 1.0));
    const double sine = here_ / behind_ * std::sin(angle);
    if (sine >= 1) return 1;
    const double bent = std::asin(sine);
    const double a = here_ * std::cos(angle), b = behind_ * std::cos(bent);
    const double c = here_ * std::cos(bent), d = behind_ * std::cos(angle);
    return (std::pow((a - b) / (a + b), 2) + std::pow((c - d) / (c + d), 2)) / 2;
}

/// Smith's function Lambda for a direction with this height.
double GlassFormulas::hidden(double height) const {
    const double z2 = height * height;
    return (std::sqrt(1 + alpha_ * alpha_ * (1 - z2) / z2) - 1) / 2;
}

double GlassFormulas::at_once(const glm::dvec3& out, const glm::dvec3& in) const {
    const bool back = in.z > 0;
    glm::dvec3 h = back ? out + in : -(here_ * out + behind_ * in);
    h /= glm::length(h);
    if (h.z < 0) h = -h;
    const double o = glm::dot(out, h), i = glm::dot(in, h);
    if (o <= 0 || (i > 0) != back) return 0;
    const double a2 = alpha_ * alpha_;
    const double spread = 1 + (a2 - 1) * h.z * h.z;
    const double facets = a2 / (std::numbers::pi * spread * spread);
    const double lo = hidden(out.z), li = hidden(std::abs(in.z));
    if (back) return std::numbers::pi * reflected(o) * facets / (1 + lo + li) / (4 * out.z);
    const double root = here_ * o + behind_ * i;
    return std::numbers::pi * (1 - reflected(o)) * facets / ((1 + lo) * (1 + li)) * o * -i / out.z *
           behind_ * behind_ / (root * root);
}

double GlassFormulas::missing(double cosine) {
    const auto found = known_.find(cosine);
    if (found != known_.end()) return found->second;
    constexpr int kHeights = 600, kTurns = 240;
    const glm::dvec3 out{std::sqrt(1 - cosine * cosine), 0, cosine};
    double sum = 0;
    for (int k = 0; k < kHeights; ++k) {
        // Steps are smaller where facets lie flat, and where they are steep and seen from the side.
        const double v = (k + 0.5) / kHeights, u = v * v * v * (10 - 15 * v + 6 * v * v);
        const double step = 30 * v * v * (1 - v) * (1 - v) / kHeights;
        const double tangent = alpha_ * std::sqrt(u / (1 - u));
        const double z = 1 / std::sqrt(1 + tangent * tangent), r = z * tangent;
        for (int t = 0; t < kTurns; ++t) {
            const double turn = std::numbers::pi * (t + 0.5) / kTurns;
            const glm::dvec3 h{r * std::cos(turn), r * std::sin(turn), z};
            const double meets = glm::dot(out, h);
            if (meets <= 0) continue;
            const double seen = step / kTurns * meets / (cosine * z);
            const double f = reflected(meets), lo = hidden(cosine);
            const glm::dvec3 mirrored = 2 * meets * h - out;
            if (mirrored.z > 0) sum += seen * f / (1 + lo + hidden(mirrored.z));
            const double eta = here_ / behind_;
            const double squared = 1 - eta * eta * (1 - meets * meets);
            if (squared <= 0) continue;
            const glm::dvec3 bent = (eta * meets - std::sqrt(squared)) * h - eta * out;
            if (bent.z < 0) sum += seen * (1 - f) / ((1 + lo) * (1 + hidden(-bent.z)));
        }
    }
    return known_[cosine] = 1 - sum;
}

double GlassFormulas::mean_missing() {
    if (mean_ >= 0) return mean_;
    constexpr int kSteps = 40;
    mean_ = 0;
    for (int k = 0; k < kSteps; ++k) {
        const double v = (k + 0.5) / kSteps, c = v * v;
        mean_ += 4 * c * v / kSteps * missing(c);
    }
    return mean_;
}

}  // namespace voxelume::oracle
