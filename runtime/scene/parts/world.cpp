// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace voxelume {

namespace {

/// The maximum mean cosine of a phase function: in narrower ones floats can't tell directions
/// apart.
constexpr double kMaxAnisotropy = 0.99;

}  // namespace

std::span<const DensityKind> density_kinds() {
    static constexpr KindKey height[] = {{"base", true}, {"scale_height", true}};
    static constexpr KindKey ball[] = {{"center", true}, {"radius", true}, {"falloff"}};
    static constexpr KindKey grid[] = {{"file", true}, {"sequence"}, {"grid"},     {"transfer"},
                                       {"lit"},        {"others"},   {"position"}, {"turn"},
                                       {"scale"},      {"matrix"}};
    static constexpr std::array<DensityKind, 3> kinds = {
        {{"height", height}, {"ball", ball}, {"grid", grid}}};
    return kinds;
}

std::span<const ValueRow<World>> world_rows() {
    static constexpr std::array<ValueRow<World>, 2> rows = {
        {{"background", &World::background, kNotNegative},
         {"ambient", &World::ambient, kNotNegative}}};
    return rows;
}

std::span<const ValueRow<Medium>> medium_rows() {
    static constexpr std::array<ValueRow<Medium>, 4> rows = {
        {{"absorption", &Medium::absorption, kNotNegative},
         {"color", &Medium::color, kNotNegative},
         {"scattering", &Medium::scattering, kNotNegative},
         {"anisotropy", &Medium::anisotropy, {-kMaxAnisotropy, kMaxAnisotropy}}}};
    return rows;
}

std::span<const ValueRow<HeightDensity>> height_density_rows() {
    static constexpr std::array<ValueRow<HeightDensity>, 2> rows = {
        {{"base", &HeightDensity::base, kCoordinate},
         {"scale_height", &HeightDensity::scale_height, kLength}}};
    return rows;
}

std::span<const ValueRow<BallDensity>> ball_density_rows() {
    static constexpr std::array<ValueRow<BallDensity>, 3> rows = {
        {{"center", &BallDensity::center, kCoordinate},
         {"radius", &BallDensity::radius, kLength},
         {"falloff", &BallDensity::falloff, kNotNegative}}};
    return rows;
}

std::span<const ValueRow<GridDensity>> grid_density_rows() {
    static constexpr std::array<ValueRow<GridDensity>, 1> rows = {{{"file", &GridDensity::file}}};
    return rows;
}

void check_ball(const BallDensity& ball, const Refuse& refuse) {
    if (ball.falloff > ball.radius)
        refuse("falloff", fmt::format("must not be larger than the radius, {}", ball.radius));
}

double distance_to_farthest_corner(const World& world, const glm::dvec3& position) {
    const Bounds bounds = lattice_bounds(world);
    double farthest = 0;
    for (int i = 0; i < 8; ++i)
        farthest = std::max(farthest, glm::distance(position, corner(bounds, i)));
    return farthest;
}

}  // namespace voxelume
