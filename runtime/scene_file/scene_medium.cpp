// SPDX-License-Identifier: Apache-2.0
// The medium of the scene's world, and its density at each place.
#include <fmt/format.h>

#include "runtime/scene_file/scene_sequence.hpp"

namespace voxelume {
namespace {

TransferPoint read_point(const SceneValue& value) {
    const SceneFields fields(value, "transfer");
    TransferPoint point;
    point.value = fields.get("value").number({-1e30, 1e30});
    point.absorption = fields.get("absorption").number(kNotNegative);
    if (const auto color = fields.find("color")) point.color = color->vector(kNotNegative);
    return point;
}

/// The points of a transfer function, whose values increase.
std::vector<TransferPoint> read_transfer(const SceneValue& value) {
    constexpr size_t kMaxPoints = 1024;
    std::vector<TransferPoint> points;
    const auto items = value.items();
    if (items.empty()) value.fail("needs at least one point");
    if (items.size() > kMaxPoints)
        value.fail(fmt::format("has {} points; at most {} are allowed", items.size(), kMaxPoints));
    for (const SceneValue& item : items) {
        const TransferPoint point = read_point(item);
        if (!points.empty() && !(point.value > points.back().value))
            item.fail(fmt::format("has the value {}, not above that of the point before it, {}",
                                  point.value, points.back().value));
        points.push_back(point);
    }
    return points;
}

/// A grid of a file, and the optical properties of its values.
GridDensity read_scan(const SceneFields& fields, std::filesystem::path path) {
    const SceneValue file = fields.get("file");
    GridDensity density;
    density.file = std::move(path);
    const auto grid = fields.find("grid");
    density.grid = grid ? grid->text() : "density";
    density.world_from_grid = read_placement(fields);
    if (const auto transfer = fields.find("transfer")) density.transfer = read_transfer(*transfer);
    if (const auto lit = fields.find("lit")) {
        if (density.transfer.empty())
            lit->fail("is of colours; give the density a \"transfer\", or leave it out");
        if (lit->is(JsonType::boolean))
            density.is_lit_by_scene = lit->boolean();
        else
            density.lit = unit_vector(lit->vector(kCoordinate), "lit", fields.refusal());
    }
    density.where = file.where();
    return density;
}

/// The further scans, which all have transfer functions.
std::vector<GridDensity> read_others(const SceneValue& value, const AssetSearch& search) {
    constexpr size_t kMaxScans = 16;
    std::vector<GridDensity> others;
    const auto items = value.items();
    if (items.size() >= kMaxScans)
        value.fail(
            fmt::format("has {} scans; at most {} are allowed", items.size(), kMaxScans - 1));
    for (const SceneValue& item : items) {
        const SceneFields fields(item, "scan");
        fields.get("transfer");
        const SceneValue file = fields.get("file");
        others.push_back(read_scan(
            fields, find_asset(file.text(), search.scene_folder, search.assets, file.where())));
    }
    return others;
}

GridDensity read_grid(const SceneFields& fields, const AssetSearch& search) {
    GridDensity density = read_scan(fields, first_file(fields, "file", search));
    if (const auto others = fields.find("others")) {
        if (density.transfer.empty())
            others->fail("are scans with transfer functions; give the first a \"transfer\", too");
        density.others = read_others(*others, search);
    }
    return density;
}

Density read_density(const SceneValue& value, const AssetSearch& search) {
    const DensityKind& kind = density_kinds()[kind_of(value, "kind", "density")];
    const SceneFields fields(value, fmt::format("density:{}", kind.name));
    if (kind.name == "height") {
        HeightDensity height;
        fields.read_kind(kind.keys, height_density_rows(), height);
        return height;
    }
    if (kind.name == "ball") {
        BallDensity ball;
        fields.read_kind(kind.keys, ball_density_rows(), ball);
        check_ball(ball, fields.refusal());
        return ball;
    }
    return read_grid(fields, search);
}

}  // namespace

Medium read_medium(const SceneValue& value, const AssetSearch& search) {
    const SceneFields fields(value, "medium");
    Medium medium;
    fields.read_rows(medium_rows(), medium);
    if (const auto density = fields.find("density"))
        medium.density = read_density(*density, search);
    // Transfer points have absorptions of their own.
    if (has_medium_colors(medium) && !fields.has("absorption")) medium.absorption = glm::vec3(1);
    return medium;
}

}  // namespace voxelume
