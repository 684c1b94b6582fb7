// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/tables/albedo_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <utility>

#include "runtime/stages/light/tables/facet_rings.hpp"

namespace voxelume {
namespace {

/// The light that surfaces of a width return at an angle of this cosine.
FacetAlbedo albedo_at(double cosine, double width) {
    FacetAlbedo sum;
    for_each_facet(cosine, width, [&sum](const SeenFacet& facet) {
        sum.all += facet.seen;
        sum.by_angle += facet.seen * squared(squared(1 - facet.meets)) * (1 - facet.meets);
    });
    return sum;
}

/// The value of one of the two rows of a table at an index between its entries.
double between(const AlbedoTable& table, int row, double at) {
    return between_entries(table.values, VXL_ALBEDO_FLOATS, row, at);
}

/// Sets the means of a table over cosines, by equal steps of their logarithms.
void set_means(double width, AlbedoTable& table) {
    for_each_cosine([&](double share, double cosine) {
        const FacetAlbedo albedo = read_albedo(table, width, cosine);
        table.missing += share * (1 - albedo.all);
        table.by_angle += share * albedo.by_angle;
    });
}

}  // namespace

double between_entries(std::span<const float> values, int rows, int row, double at) {
    const int entry = std::clamp(int(at), 0, kLastAlbedo - 1);
    const double part = at - entry;
    const auto value = [&](int i) {
        return double(values[size_t(i) * size_t(rows) + size_t(row)]);
    };
    return value(entry) * (1 - part) + value(entry + 1) * part;
}

FacetAlbedo read_albedo(const AlbedoTable& table, double width, double cosine) {
    const double at = kLastAlbedo * std::sqrt(cosine * (1 + width) / (cosine + width));
    const double all = 1 - between(table, VXL_ALBEDO_MISSING, at);
    return {all, all * between(table, VXL_ALBEDO_BY_ANGLE, kLastAlbedo * std::sqrt(cosine))};
}

double width_of(double roughness) {
    return std::max(squared(roughness), 1.0 / 1024);
}

namespace {

AlbedoTable new_table(double width) {
    AlbedoTable table;
    for (int entry = 0; entry <= kLastAlbedo; ++entry) {
        const double u = squared(double(entry) / kLastAlbedo);
        const FacetAlbedo missed = albedo_at(std::min(width * u / (1 + width - u), 1.0), width);
        const FacetAlbedo turned = albedo_at(u, width);
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

double multiple_share(double reflectance, double missing, double grazing) {
    const double mean = reflectance + (grazing - reflectance) / 21;
    return squared(mean) * (1 - missing) / (1 - mean * missing);
}

double passed_share(double reflectance, const AlbedoMeans& means, double grazing) {
    const double all = means.entered - means.missing;
    const double at_once = reflectance * (all - means.by_angle) + grazing * means.by_angle;
    const double later = multiple_share(reflectance, means.missing / means.entered, grazing);
    return means.entered - at_once - later * means.missing;
}

}  // namespace voxelume
