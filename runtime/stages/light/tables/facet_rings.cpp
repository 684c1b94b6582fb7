// SPDX-License-Identifier: Apache-2.0
// The albedo of facets is the mean, over visible facets, of the part that other facets don't hide:
// Heitz 2014, "Understanding the Masking-Shadowing Function". Visible facets are sampled as in
// Dupuy & Benyoub 2023, by points of a spherical cap.
#include "runtime/stages/light/tables/facet_rings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace voxelume {
namespace {

/// Light that comes to facets at an angle, and the reflection of a ring of facets that it reaches.
/// With the surface stretched until facets are a sphere, the light comes along (x, 0, z).
struct FacetRing {
    double width = 1, sine = 0, cosine = 1;  // width of highlights; angle of the light
    double length = 1, x = 0, z = 1;         // of (width * sine, 0, cosine), and its direction
    double radius = 0, height = 0;           // of the ring

    /// The angles around the ring that mirror light upwards: the height of the mirrored direction
    /// is a quotient of linear functions of the angle's cosine.
    std::pair<double, double> upward() const {
        const double a2 = squared(width);
        const double slope = 2 * radius * (height * width * sine - cosine * a2 * x);
        const double level = cosine * (a2 * (squared(radius) + squared(x)) + squared(height)) -
                             2 * height * (width * sine * x + height * cosine);
        if (slope == 0) return {0, level <= 0 ? std::numbers::pi : 0};
        const double edge = std::acos(std::clamp(level / slope, -1.0, 1.0));
        if (slope > 0) return {0, edge};
        return {edge, std::numbers::pi};
    }

    /// The facets at an angle around the ring, which are `share` of all.
    SeenFacet at(double turn, double share) const {
        const double hx = width * (radius * std::cos(turn) + x);
        const double across = width * radius, along = hx - width * x;
        const double hy2 = squared(across) - squared(along);
        const double h = std::sqrt(squared(hx) + hy2 + squared(height));
        const double meets = (hx * sine + height * cosine) / h;
        const double out = 2 * meets * height / h - cosine;
        if (out <= 0) return {0, out, meets};
        const double other = std::sqrt(squared(width) * (1 - squared(out)) + squared(out));
        const double seen = share * (length + cosine) * out / (length * out + other * cosine);
        return {seen, out, meets};
    }
};

}  // namespace

void for_each_facet(double cosine, double width, const std::function<void(const SeenFacet&)>& add) {
    constexpr int kRings = 128, kParts = 32;  // parts of half a ring; the other half is its mirror
    FacetRing ring;
    ring.width = width, ring.sine = std::sqrt(1 - squared(cosine)), ring.cosine = cosine;
    ring.length = std::sqrt(squared(width * ring.sine) + squared(cosine));
    ring.x = width * ring.sine / ring.length, ring.z = cosine / ring.length;
    const double last = std::acos(-ring.z);
    for (int i = 0; i < kRings; ++i) {
        const double v = (i + 0.5) / kRings;
        const double angle = last * v * v * (3 - 2 * v);  // closer at the ends, where edges are
        const double breadth = last * 6 * v * (1 - v) / kRings;
        ring.radius = std::sin(angle), ring.height = std::cos(angle) + ring.z;
        const auto [begin, end] = ring.upward();
        const double step = (end - begin) / kParts;
        const double share = ring.radius * breadth / (1 + ring.z) * step / std::numbers::pi;
        for (int k = 0; k < kParts; ++k) {
            const SeenFacet facet = ring.at(begin + step * (k + 0.5), share);
            if (facet.out > 0) add(facet);
        }
    }
}

void for_each_cosine(const std::function<void(double share, double cosine)>& add) {
    constexpr int kSteps = 4096;  // steps of the cosines' logarithms
    constexpr double kMin = 1e-6;
    const auto at = [](double step) { return std::pow(kMin, 1 - step / kSteps); };
    for (int step = 0; step < kSteps; ++step)
        add(squared(at(step + 1)) - squared(at(step)), at(step + 0.5));
}

}  // namespace voxelume
