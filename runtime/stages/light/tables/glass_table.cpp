// SPDX-License-Identifier: Apache-2.0
// The light returned at once is the mean over visible facets, sampled by points of a spherical cap
// (Dupuy & Benyoub 2023), of what each reflects and refracts, without the part that others hide.
#include "runtime/stages/light/tables/glass_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>

namespace voxelume {
namespace {

double second_power(double x) {
    return x * x;
}

/// Fresnel's reflectance of unpolarised light, and the cosine of the refracted angle: 0 for total
/// reflection.
struct Bend {
    double reflected = 1, cosine = 0;
};

Bend bend_at(double eta, double c) {
    const double squared = 1 - second_power(eta) * (1 - second_power(c));
    if (squared <= 0) return {};
    const double t = std::sqrt(squared);
    const double across = (eta * c - t) / (eta * c + t), along = (c - eta * t) / (c + eta * t);
    return {(second_power(across) + second_power(along)) / 2, t};
}

/// The length of a unit vector of this height after its horizontal part is scaled by `width`: it
/// decides how much light facets hide from each other.
double stretched(double width, double height) {
    return std::sqrt(second_power(width) * (1 - second_power(height)) + second_power(height));
}

struct Returned {
    double back = 0, through = 0;
};

/// The light that a surface returns at once at an angle of this cosine. `eta` is the index on the
/// light's side over the other.
Returned returned_at(double cosine, double width, double eta) {
    constexpr int kRings = 192, kParts = 96;
    const double sine = std::sqrt(1 - second_power(cosine)), k_out = stretched(width, cosine);
    const double view_x = width * sine / k_out, view_z = cosine / k_out;
    Returned sum;
    for (int i = 0; i < kRings; ++i) {
        // Rings are closer at the rim of the cap, where facets are steep.
        const double v = (i + 0.5) / kRings, u = v * v * (3 - 2 * v);
        const double share = 6 * v * (1 - v) / (kRings * kParts);
        const double z = 1 - u * (1 + view_z),
                     radius = std::sqrt(std::max(1 - second_power(z), 0.0));
        for (int k = 0; k < kParts; ++k) {
            const double turn = std::numbers::pi * (k + 0.5) / kParts;  // the other half mirrors it
            double hx = width * (radius * std::cos(turn) + view_x);
            double hz = z + view_z;
            const double hy = width * radius * std::sin(turn);
            const double length = std::sqrt(hx * hx + hy * hy + hz * hz);
            hx /= length, hz /= length;
            const double meets = std::clamp(hx * sine + hz * cosine, 0.0, 1.0);
            const Bend bend = bend_at(eta, meets);
            const double up = 2 * meets * hz - cosine;
            if (up > 0) {
                const double k_in = stretched(width, up);
                sum.back +=
                    share * bend.reflected * (k_out + cosine) * up / (k_out * up + k_in * cosine);
            }
            const double down = (eta * meets - bend.cosine) * hz - eta * cosine;
            if (bend.cosine > 0 && down < 0)
                sum.through +=
                    share * (1 - bend.reflected) * 2 * -down / (stretched(width, -down) - down);
        }
    }
    return sum;
}

constexpr int kLastAngle = VXL_GLASS_ENTRIES - 1;

/// The index of a cosine in tables, from 0 to kLastAngle.
double index_of(double width, double cosine) {
    return kLastAngle * (std::sqrt(cosine * (1 + width) / (cosine + width)) + cosine) / 2;
}

/// The cosine of an index, found by bisection.
double cosine_at(double width, double index) {
    constexpr int kHalves = 60;
    double low = 0, high = 1;
    for (int i = 0; i < kHalves; ++i) {
        const double middle = (low + high) / 2;
        (index_of(width, middle) < index ? low : high) = middle;
    }
    return high;
}

/// The missing share of a side that kernels read for a cosine.
double missing_at(const GlassTable& table, size_t side, double width, double cosine) {
    const double at = index_of(width, cosine);
    const int entry = std::min(int(at), kLastAngle - 1);
    const double low = table.values[size_t(2 * entry) + side];
    const double high = table.values[size_t(2 * entry + 2) + side];
    return low + (at - entry) * (high - low);
}

/// Sets the missing shares of a side, and their mean.
void set_side(double width, double eta, size_t side, GlassTable& table) {
    for (int entry = 0; entry <= kLastAngle; ++entry) {
        const double cosine = std::max(cosine_at(width, entry), 1e-7);
        const Returned r = returned_at(cosine, width, eta);
        table.values[size_t(2 * entry) + side] = float(std::max(1 - r.back - r.through, 0.0));
    }
    constexpr int kSteps = 4096;
    constexpr double kMin = 1e-9;  // minimum of a mean that others are divided by
    double sum = 0;
    for (int step = 0; step < kSteps; ++step) {
        const double cosine = (step + 0.5) / kSteps;
        sum += 2 * cosine / kSteps * missing_at(table, side, width, cosine);
    }
    table.missing[side] = std::max(sum, kMin);
}

/// The part of uniform light from outside, of all that facets return at once, that gets through.
double part_through(double width, double ior) {
    constexpr int kAngles = 32;
    Returned sum;
    for (int i = 0; i < kAngles; ++i) {
        const double cosine = (i + 0.5) / kAngles;
        const Returned r = returned_at(cosine, width, 1 / ior);
        sum.back += cosine * r.back;
        sum.through += cosine * r.through;
    }
    return sum.through / (sum.through + sum.back);
}

GlassTable make_glass_table(double width, double ior) {
    GlassTable table;
    set_side(width, 1 / ior, 0, table);
    set_side(width, ior, 1, table);
    // Light after the first scattering passes equally in both directions, per square of the index,
    // so that paths are reversible. From outside, the part of it that passes equals that of the
    // light that is returned at once.
    const double squared = second_power(ior);
    const double max = squared / table.missing[0];
    const double scale = std::min(part_through(width, ior) / table.missing[1], max);
    table.back = {1 - scale * table.missing[1], 1 - scale / max};
    return table;
}

}  // namespace

GlassTable glass_table(double width, double ior) {
    constexpr size_t kMaxKept = 1024;
    static std::mutex mutex;
    static std::map<std::pair<double, double>, GlassTable> kept;
    const std::pair<double, double> key(width, ior);
    {
        const std::lock_guard lock(mutex);
        if (const auto found = kept.find(key); found != kept.end()) return found->second;
    }
    const GlassTable table = make_glass_table(width, ior);
    const std::lock_guard lock(mutex);
    if (kept.size() < kMaxKept) kept.emplace(key, table);
    return table;
}

}  // namespace voxelume
