// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/tables/coat_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <utility>

#include "runtime/stages/light/tables/facet_rings.hpp"

namespace voxelume {
namespace {

constexpr double kCoatReflectance = VXL_COAT_REFLECTANCE;

/// The excess of the coat's reflection in the directions of facets below over that at the angle
/// itself, on average over the facets: of all light, and of the part (1 - m)^5.
FacetAlbedo losses_at(double cosine, double coat_width, double width, const AlbedoTable& coat) {
    const double here = coat_returned(coat, coat_width, cosine);
    FacetAlbedo losses, seen;
    for_each_facet(cosine, width, [&](const SeenFacet& facet) {
        const double there = coat_returned(coat, coat_width, facet.out);
        const double more = std::max(there - here, 0.0);
        const double far = 1 - facet.meets, by_angle = facet.seen * far * far * far * far * far;
        seen.all += facet.seen, seen.by_angle += by_angle;
        losses.all += facet.seen * more, losses.by_angle += by_angle * more;
    });
    return {losses.all / seen.all, losses.by_angle / seen.by_angle};
}

CoatTable new_table(double coat_width, double width) {
    const AlbedoTable coat = albedo_table(coat_width), below = albedo_table(width);
    CoatTable table;
    for (int entry = 0; entry <= kLastAlbedo; ++entry) {
        const double u = double(entry) / kLastAlbedo, cosine = std::max(u * u, 1e-7);
        const FacetAlbedo losses = losses_at(cosine, coat_width, width, coat);
        table.values[size_t(entry) * 2] = float(losses.all);
        table.values[size_t(entry) * 2 + 1] = float(losses.by_angle);
    }
    for_each_cosine([&](double share, double cosine) {
        const double returned = coat_returned(coat, coat_width, cosine);
        const FacetAlbedo facets = read_albedo(below, width, cosine);
        const auto lost = [&](int row) {
            return between_entries(table.values, 2, row, kLastAlbedo * std::sqrt(cosine));
        };
        table.returned += share * returned;
        table.taken += share * facets.all * (returned + lost(0));
        table.taken_by_angle += share * facets.by_angle * (returned + lost(1));
    });
    return table;
}

}  // namespace

double coat_later(const AlbedoTable& table) {
    return multiple_share(kCoatReflectance, table.missing);
}

double coat_returned(const AlbedoTable& table, double width, double cosine) {
    const FacetAlbedo albedo = read_albedo(table, width, cosine);
    const double at_once = kCoatReflectance * (albedo.all - albedo.by_angle) + albedo.by_angle;
    return at_once + coat_later(table) * (1 - albedo.all);
}

CoatTable coat_table(double coat_width, double width) {
    constexpr size_t kMaxKept = 4096;  // 2 MB
    static std::mutex mutex;
    static std::map<std::pair<double, double>, CoatTable> kept;
    const std::pair key(coat_width, width);
    {
        const std::lock_guard lock(mutex);
        if (const auto found = kept.find(key); found != kept.end()) return found->second;
    }
    const CoatTable table = new_table(coat_width, width);
    const std::lock_guard lock(mutex);
    if (kept.size() < kMaxKept) kept.emplace(key, table);
    return table;
}

AlbedoMeans means_under_coat(const AlbedoMeans& facets, const CoatTable& coat, double share) {
    AlbedoMeans means;
    means.entered = 1 - share * coat.returned;
    means.by_angle = facets.by_angle - share * coat.taken_by_angle;
    means.missing = means.entered - (1 - facets.missing - share * coat.taken);
    return means;
}

}  // namespace voxelume
