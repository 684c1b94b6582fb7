// The medium of the scene's world, and where it is how dense.
#include <fmt/format.h>

#include "runtime/scene_file/scene_sequence.hpp"

namespace voxelume {
namespace {

HeightDensity read_height(const SceneFields& fields) {
    return {fields.get("base").number(kCoordinate), fields.get("scale_height").number(kLength)};
}

BallDensity read_ball(const SceneFields& fields) {
    BallDensity ball;
    ball.center = fields.get("center").vector(kCoordinate);
    ball.radius = fields.get("radius").number(kLength);
    if (const auto falloff = fields.find("falloff")) {
        ball.falloff = falloff->number(kNotNegative);
        if (ball.falloff > ball.radius)
            falloff->fail(fmt::format("must not be larger than the radius, {}", ball.radius));
    }
    return ball;
}

GridDensity read_grid(const SceneFields& fields, const AssetSearch& search) {
    const SceneValue file = fields.get("file");
    GridDensity density;
    density.file = file_at(fields, "file", search);
    const auto grid = fields.find("grid");
    density.grid = grid ? grid->text() : "density";
    density.world_from_grid = read_placement(fields);
    density.where = file.where();
    return density;
}

Density read_density(const SceneValue& value, const AssetSearch& search) {
    const std::string_view kind = scene_kinds("density")[kind_of(value, "kind", "density")];
    const SceneFields fields(value, fmt::format("density:{}", kind));
    if (kind == "height") return read_height(fields);
    if (kind == "ball") return read_ball(fields);
    return read_grid(fields, search);
}

}  // namespace

Medium read_medium(const SceneValue& value, const AssetSearch& search) {
    const SceneFields fields(value, "medium");
    Medium medium;
    medium.absorption = fields.color("absorption", kMaxLength, {});
    medium.color = fields.color("color", kMaxLength, {});
    if (const auto density = fields.find("density"))
        medium.density = read_density(*density, search);
    return medium;
}

}  // namespace voxelume
