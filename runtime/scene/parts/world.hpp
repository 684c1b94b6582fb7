// SPDX-License-Identifier: Apache-2.0
// The world S: its lattice, and the medium between the objects.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "runtime/base/source_place.hpp"
#include "runtime/scene/parts/bounds.hpp"
#include "runtime/scene/parts/sky.hpp"
#include "runtime/scene/parts/value_row.hpp"

namespace voxelume {

/// Density 1 up to the height `base`; above it the density falls by a factor of e per
/// `scale_height`.
struct HeightDensity {
    double base = 0;          ///< metres along Y
    double scale_height = 1;  ///< metres, > 0

    friend bool operator==(const HeightDensity&, const HeightDensity&) = default;
};

/// Density 1 in a ball; over its outer `falloff` metres it falls smoothly to 0.
struct BallDensity {
    glm::dvec3 center{0};  ///< metres
    double radius = 1;     ///< metres, > 0
    double falloff = 0;    ///< metres, 0..radius

    friend bool operator==(const BallDensity&, const BallDensity&) = default;
};

/// The optical properties of a scan's medium at one value.
struct TransferPoint {
    double value = 0;
    double absorption = 0;  ///< per metre, >= 0
    glm::vec3 color{1};     ///< radiance that an infinitely deep medium of this value shows, >= 0

    friend bool operator==(const TransferPoint&, const TransferPoint&) = default;
};

/// A float grid of an OpenVDB file, or an array of values, which have transforms of their own to
/// metres.
struct GridDensity {
    std::filesystem::path file{};
    std::string grid{};             ///< name in the file
    glm::dmat4 world_from_grid{1};  ///< from the grid's metres; affine and safely invertible
    /// The transfer function from values to densities and colours, by ascending values. Empty:
    /// values are densities.
    std::vector<TransferPoint> transfer{};
    /// With a transfer function: unit vector of the light that shows its surfaces; 0: none.
    glm::dvec3 lit{0};
    bool is_lit_by_scene = false;  ///< with a transfer function: lit by the scene's lights instead
    /// With a transfer function: further scans, with transfer functions and placements of their own
    /// and no `others`. Their absorptions add up.
    std::vector<GridDensity> others{};
    SourcePlace where{};

    friend bool operator==(const GridDensity&, const GridDensity&) = default;
};

/// The medium's density at the world's voxels; without any it is 1 everywhere.
using Density = std::variant<std::monostate, HeightDensity, BallDensity, GridDensity>;

/// The medium between the objects.
struct Medium {
    glm::vec3 absorption{0};  ///< per metre at density 1, >= 0
    glm::vec3 color{0};       ///< radiance that an infinitely deep medium shows, >= 0
    glm::vec3 scattering{0};  ///< per metre at density 1, >= 0; only in global light
    double anisotropy = 0;    ///< mean cosine of the angle by which light is scattered, -1..1
    Density density;

    friend bool operator==(const Medium&, const Medium&) = default;
};

/// True if the medium's density differs from voxel to voxel.
inline bool has_density(const Medium& medium) {
    return !std::holds_alternative<std::monostate>(medium.density);
}

/// S: its lattice starts at `bounds.min`; the last voxels may reach past `bounds.max`.
struct World {
    glm::dvec3 voxel_size{0};  ///< metres per axis, > 0
    int resolution = 256;      ///< voxels along the longest side, where no voxel size is given
    Bounds bounds;             ///< metres
    glm::ivec3 voxels{0};      ///< per axis: bounds over voxel_size, rounded up
    glm::vec3 background{0};   ///< radiance where a ray leaves the world
    glm::vec3 ambient{0};      ///< light that reaches every surface
    Medium medium;
    std::optional<Sky> sky;  ///< replaces the background
    SourcePlace where;       ///< "file:line:column: world", which opens messages

    friend bool operator==(const World&, const World&) = default;
};

/// The box that the world's whole voxels fill.
inline Bounds lattice_bounds(const World& world) {
    return {world.bounds.min, world.bounds.min + glm::dvec3(world.voxels) * world.voxel_size};
}

/// True if the medium's colour differs from voxel to voxel.
inline bool has_medium_colors(const Medium& medium) {
    const auto* grid = std::get_if<GridDensity>(&medium.density);
    return grid && !grid->transfer.empty();
}

/// True if the sky has a sun that shines.
inline bool has_sun(const World& world) {
    return world.sky && world.sky->kind == SkyKind::sun && world.sky->intensity > 0;
}

/// A kind of density, in the order of the alternatives of `Density` after the first.
struct DensityKind {
    std::string_view name;  ///< in scene files
    std::span<const KindKey> keys;
};
std::span<const DensityKind> density_kinds();

/// The world's numeric values that may change.
std::span<const ValueRow<World>> world_rows();
std::span<const ValueRow<Medium>> medium_rows();
std::span<const ValueRow<HeightDensity>> height_density_rows();
std::span<const ValueRow<BallDensity>> ball_density_rows();
std::span<const ValueRow<GridDensity>> grid_density_rows();

/// Refuses a ball with a falloff larger than its radius.
void check_ball(const BallDensity& ball, const Refuse& refuse);

/// Metres from a position to the farthest corner of the world's voxels.
double distance_to_farthest_corner(const World& world, const glm::dvec3& position);

}  // namespace voxelume
