// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/physical_surface.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
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

double schlick(double reflectance, double cosine, double grazing = 1) {
    return reflectance + (grazing - reflectance) * std::pow(1 - cosine, 5);
}

constexpr double kCoat = 0.04;  // ((1.5 - 1) / (1.5 + 1))^2

/// The sum over facets of the share that each returns. `reflects` is the part of light that a facet
/// mirrors, for light that meets it at an angle and leaves at another.
double sum_of_facets(double cosine, double alpha, int parts,
                     const std::function<double(double meets, double out)>& reflects) {
    const glm::dvec3 o = at_cosine(cosine);
    double sum = 0;
    for (int k = 0; k < parts; ++k) {
        // The facets' areas are divided into shares, which are finer for steep facets.
        const double rest = std::pow(1 - (k + 0.5) / parts, 3);
        const double tangent = alpha * std::sqrt((1 - rest * rest) / (rest * rest));
        for (int j = 0; j < parts; ++j) {
            const glm::dvec3 h =
                at_cosine(1 / std::sqrt(1 + tangent * tangent), kPi * (j + 0.5) / parts);
            const double meets = glm::dot(o, h);
            const glm::dvec3 i = 2 * meets * h - o;
            if (meets <= 0 || i.z <= 0) continue;
            const double seen =
                meets / (o.z * h.z) / (1 + lambda_of(o, alpha) + lambda_of(i, alpha));
            // A facet's share is proportional to the derivative of the sixth power of the remaining
            // parts.
            sum += seen * reflects(meets, i.z) * 6 * std::pow(1 - (k + 0.5) / parts, 5) /
                   (parts * parts);
        }
    }
    return sum;
}

/// The mean over all directions, weighted by their cosine: Gauss and Legendre's six points for
/// means over the cosine's square.
double mean_of(const std::function<double(double cosine)>& value) {
    constexpr double kAt[] = {0.0337652429, 0.1693953068, 0.3806904070};
    constexpr double kShare[] = {0.0856622462, 0.1803807865, 0.2339569673};
    double sum = 0;
    for (int k = 0; k < 3; ++k)
        for (const double square : {kAt[k], 1 - kAt[k]})
            sum += kShare[k] * value(std::sqrt(square));
    return sum;
}

double later_of(double f0, double missing, double grazing = 1) {
    const double mean = f0 + (grazing - f0) / 21;
    return mean * mean * (1 - missing) / (1 - mean * missing);
}

}  // namespace

glm::dvec3 at_cosine(double cosine, double turn) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(turn), sine * std::sin(turn), cosine};
}

double facet_albedo(double cosine, double alpha, double reflectance) {
    return sum_of_facets(cosine, alpha, 300,
                         [&](double meets, double) { return schlick(reflectance, meets); });
}

CoatFormulas::CoatFormulas(double alpha) : alpha_(alpha) {
    constexpr int kEntries = 129, kParts = 160;
    for (int k = 0; k < kEntries; ++k) {
        const double cosine = std::pow(std::max(k, 1) / (kEntries - 1.0), 2);
        Entry entry{};
        entry.all = sum_of_facets(cosine, alpha, kParts, [](double, double) { return 1; });
        entry.once = sum_of_facets(cosine, alpha, kParts,
                                   [](double meets, double) { return schlick(kCoat, meets); });
        entries_.push_back(entry);
    }
    missing_ = mean_of([&](double cosine) { return 1 - at(cosine).all; });
    later_ = later_of(kCoat, missing_);
}

CoatFormulas::Entry CoatFormulas::at(double cosine) const {
    const double place = std::sqrt(cosine) * double(entries_.size() - 1);
    const size_t first = std::min(size_t(place), entries_.size() - 2);
    const Entry &low = entries_[first], &high = entries_[first + 1];
    const double part = place - double(first);
    return {low.all + part * (high.all - low.all), low.once + part * (high.once - low.once)};
}

double CoatFormulas::returned(double cosine) const {
    const Entry entry = at(cosine);
    return entry.once + later_ * (1 - entry.all);
}

double CoatFormulas::value(const glm::dvec3& out, const glm::dvec3& in) const {
    const double met = glm::dot(glm::normalize(out + in), in);
    const double both = (1 - at(out.z).all) * (1 - at(in.z).all);
    return kPi * in.z *
           (facets_between(out, in, alpha_) * schlick(kCoat, met) + later_ * both / missing_ / kPi);
}

PhysicalFormulas::PhysicalFormulas(const PhysicalValues& surface)
    : s_(surface),
      coat_(surface.coat > 0 ? surface.coat_roughness * surface.coat_roughness : 1),
      alpha_(surface.roughness * surface.roughness),
      f0_(surface.specular * std::pow((surface.ior - 1) / (surface.ior + 1), 2)) {
    all_ = mean_of([&](double cosine) { return albedo(cosine, 1, 1); });
    plain_ = mean_of([&](double cosine) { return albedo(cosine, f0_, s_.specular); });
    entered_ = mean_of([&](double cosine) { return entered(cosine); });
}

double PhysicalFormulas::entered(double cosine) const {
    return 1 - s_.coat * coat_.returned(cosine);
}

double PhysicalFormulas::albedo(double cosine, double reflectance, double grazing) {
    const auto [found, is_new] = known_.try_emplace({cosine, reflectance});
    if (is_new)
        found->second = sum_of_facets(cosine, alpha_, 300, [&](double meets, double out) {
            return schlick(reflectance, meets, grazing) * std::min(entered(cosine), entered(out));
        });
    return found->second;
}

double PhysicalFormulas::later(double f0, double grazing) const {
    return later_of(f0, 1 - all_ / entered_, grazing);
}

double PhysicalFormulas::missing(double cosine) {
    return entered(cosine) - albedo(cosine, 1, 1);
}

double PhysicalFormulas::passed(double cosine) {
    return entered(cosine) - albedo(cosine, f0_, s_.specular) -
           later(f0_, s_.specular) * missing(cosine);
}

double PhysicalFormulas::value(const glm::dvec3& out, const glm::dvec3& in, int channel) {
    const double met = glm::dot(glm::normalize(out + in), in), base = s_.base[channel];
    const double both = missing(out.z) * missing(in.z), mean = entered_ - all_;
    const double at_once =
        facets_between(out, in, alpha_) * std::min(entered(out.z), entered(in.z));
    const auto facets = [&](double f0, double grazing) {
        return at_once * schlick(f0, met, grazing) + later(f0, grazing) * both / mean / kPi;
    };
    const double mean_passed = entered_ - plain_ - later(f0_, s_.specular) * mean;
    const double matt = base / kPi * passed(out.z) * passed(in.z) / mean_passed;
    const double below =
        s_.metallic * facets(base, 1) + (1 - s_.metallic) * (facets(f0_, s_.specular) + matt);
    return kPi * in.z * below + s_.coat * coat_.value(out, in);
}

}  // namespace voxelume::oracle
