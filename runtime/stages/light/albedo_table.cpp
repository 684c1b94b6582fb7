// SPDX-License-Identifier: Apache-2.0
// The albedo of facets is the mean, over those that are seen, of the part that others don't hide:
// Heitz 2014, "Understanding the Masking-Shadowing Function"; seen facets as Dupuy & Benyoub 2023
// find them, by points of a spherical cap.
#include "runtime/stages/light/albedo_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>

namespace voxelume {
namespace {

struct Albedo {
    double all = 0, by_angle = 0;
};

double square(double x) {
    return x * x;
}

/// Light that comes at an angle to facets, and what a ring of those that it sees returns. With the
/// surface stretched until facets are a sphere, the light comes along (x, 0, z).
struct FacetRing {
    double width = 1, sine = 0, cosine = 1;  // the light's
    double length = 1, x = 0, z = 1;         // of (width * sine, 0, cosine), and its direction
    double radius = 0, height = 0;           // the ring's

    /// The angles around the ring that mirror light upwards: the height of the mirrored direction
    /// is a quotient of linear functions of the angle's cosine.
    std::pair<double, double> upward() const {
        const double a2 = square(width);
        const double slope = 2 * radius * (height * width * sine - cosine * a2 * x);
        const double level = cosine * (a2 * (square(radius) + square(x)) + square(height)) -
                             2 * height * (width * sine * x + height * cosine);
        if (slope == 0) return {0, level <= 0 ? std::numbers::pi : 0};
        const double edge = std::acos(std::clamp(level / slope, -1.0, 1.0));
        if (slope > 0) return {0, edge};
        return {edge, std::numbers::pi};
    }

    /// Adds the facets at an angle around the ring, by a share of all.
    void add(double turn, double share, Albedo& sum) const {
        const double hx = width * (radius * std::cos(turn) + x);
        const double across = width * radius, along = hx - width * x;
        const double hy2 = square(across) - square(along);
        const double h = std::sqrt(square(hx) + hy2 + square(height));
        const double meets = (hx * sine + height * cosine) / h;
        const double out = 2 * meets * height / h - cosine;
        if (out <= 0) return;
        const double other = std::sqrt(square(width) * (1 - square(out)) + square(out));
        const double seen = share * (length + cosine) * out / (length * out + other * cosine);
        sum.all += seen;
        sum.by_angle += seen * square(square(1 - meets)) * (1 - meets);
    }
};

/// What surfaces of a width return of light at an angle of this cosine.
Albedo albedo_at(double cosine, double width) {
    constexpr int kRings = 128, kParts = 32;  // parts of half a ring; the other half is its mirror
    FacetRing ring;
    ring.width = width, ring.sine = std::sqrt(1 - square(cosine)), ring.cosine = cosine;
    ring.length = std::sqrt(square(width * ring.sine) + square(cosine));
    ring.x = width * ring.sine / ring.length, ring.z = cosine / ring.length;
    const double last = std::acos(-ring.z);
    Albedo sum;
    for (int i = 0; i < kRings; ++i) {
        const double v = (i + 0.5) / kRings;
        const double angle = last * v * v * (3 - 2 * v);  // closer at the ends, where edges are
        const double breadth = last * 6 * v * (1 - v) / kRings;
        ring.radius = std::sin(angle), ring.height = std::cos(angle) + ring.z;
        const auto [begin, end] = ring.upward();
        const double step = (end - begin) / kParts;
        const double share = ring.radius * breadth / (1 + ring.z) * step / std::numbers::pi;
        for (int k = 0; k < kParts; ++k) ring.add(begin + step * (k + 0.5), share, sum);
    }
    return sum;
}

constexpr int kLast = VXL_ALBEDO_ENTRIES - 1;

/// The value of one of the two rows of a table at a place between its entries.
double between(const AlbedoTable& table, int row, double at) {
    const int entry = std::clamp(int(at), 0, kLast - 1);
    const double part = at - entry;
    const auto value = [&](int i) {
        return double(table.values[size_t(i) * VXL_ALBEDO_FLOATS + size_t(row)]);
    };
    return value(entry) * (1 - part) + value(entry + 1) * part;
}

/// What kernels read from a table.
Albedo read(const AlbedoTable& table, double width, double cosine) {
    const double at = kLast * std::sqrt(cosine * (1 + width) / (cosine + width));
    const double all = 1 - between(table, VXL_ALBEDO_MISSING, at);
    return {all, all * between(table, VXL_ALBEDO_BY_ANGLE, kLast * std::sqrt(cosine))};
}

/// Sets the means of a table over cosines, by equal steps of their logarithms.
void set_means(double width, AlbedoTable& table) {
    constexpr int kSteps = 4096;
    constexpr double kLeast = 1e-6;
    const auto at = [](double step) { return std::pow(kLeast, 1 - step / kSteps); };
    for (int step = 0; step < kSteps; ++step) {
        const double share = square(at(step + 1)) - square(at(step));
        const Albedo albedo = read(table, width, at(step + 0.5));
        table.missing += share * (1 - albedo.all);
        table.by_angle += share * albedo.by_angle;
    }
}

}  // namespace

double width_of(double roughness) {
    return std::max(square(roughness), 1.0 / 1024);
}

namespace {

AlbedoTable new_table(double width) {
    AlbedoTable table;
    for (int entry = 0; entry <= kLast; ++entry) {
        const double u = square(double(entry) / kLast);
        const Albedo missed = albedo_at(std::min(width * u / (1 + width - u), 1.0), width);
        const Albedo turned = albedo_at(u, width);
        float* values = &table.values[size_t(entry) * VXL_ALBEDO_FLOATS];
        values[VXL_ALBEDO_MISSING] = float(std::max(1 - missed.all, 0.0));
        values[VXL_ALBEDO_BY_ANGLE] = float(turned.by_angle / turned.all);
    }
    set_means(width, table);
    return table;
}

}  // namespace

AlbedoTable albedo_table(double width) {
    constexpr size_t kMaxKept = 4096;  // 2 MB
    static std::mutex mutex;
    static std::map<double, AlbedoTable> kept;
    {
        const std::lock_guard lock(mutex);
        if (const auto found = kept.find(width); found != kept.end()) return found->second;
    }
    const AlbedoTable table = new_table(width);
    const std::lock_guard lock(mutex);
    if (kept.size() < kMaxKept) kept.emplace(width, table);
    return table;
}

double multiple_share(double reflectance, double missing) {
    const double mean = reflectance + (1 - reflectance) / 21;
    return square(mean) * (1 - missing) / (1 - mean * missing);
}

double passed_share(double reflectance, const AlbedoTable& table) {
    const double at_once = reflectance * (1 - table.missing - table.by_angle) + table.by_angle;
    return 1 - at_once - multiple_share(reflectance, table.missing) * table.missing;
}

}  // namespace voxelume
