// SPDX-License-Identifier: Apache-2.0
// The medium of the scene's world, and where it is how dense.
#include <fmt/format.h>

#include "runtime/scene_file/scene_sequence.hpp"

namespace voxelume {
namespace {

GridDensity read_grid(const SceneFields& fields, const AssetSearch& search) {
    const SceneValue file = fields.get("file");
    GridDensity density;
    density.file = first_file(fields, "file", search);
    const auto grid = fields.find("grid");
    density.grid = grid ? grid->text() : "density";
    density.world_from_grid = read_placement(fields);
    density.where = file.where();
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
    return medium;
}

}  // namespace voxelume
