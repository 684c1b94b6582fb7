// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/sky.hpp"

#include <array>

namespace voxelume {

std::span<const SkyType> sky_types() {
    static constexpr KindKey constant[] = {{"color", true}, {"strength"}, {"samples"}, {"visible"}};
    static constexpr KindKey gradient[] = {{"zenith"},   {"horizon"}, {"ground"},
                                           {"strength"}, {"samples"}, {"visible"}};
    static constexpr KindKey sun[] = {
        {"direction", true}, {"angle"},     {"color", false, kNotNegative},
        {"intensity"},       {"turbidity"}, {"ground"},
        {"strength"},        {"samples"},   {"visible"}};
    static constexpr KindKey map[] = {
        {"file", true}, {"rotation"}, {"strength"}, {"samples"}, {"visible"}};
    static constexpr std::array<SkyType, 4> types = {
        {{"constant", constant}, {"gradient", gradient}, {"sun", sun}, {"map", map}}};
    return types;
}

std::span<const ValueRow<Sky>> sky_rows() {
    static constexpr std::array<ValueRow<Sky>, 12> rows = {{
        {"color", &Sky::color, kNotNegative},
        {"zenith", &Sky::zenith, kNotNegative},
        {"horizon", &Sky::horizon, kNotNegative},
        {"ground", &Sky::ground, kNotNegative},
        {"strength", &Sky::strength, kNotNegative},
        {"samples", &Sky::samples, {0, 1024}},
        {"direction", &Sky::direction, kCoordinate},
        {"angle", &Sky::angle, {0, 90, true}},
        {"intensity", &Sky::intensity, kNotNegative},
        {"turbidity", &Sky::turbidity, {2, 10}},
        {"visible", &Sky::visible},
        {"rotation", &Sky::rotation, kDegrees},
    }};
    return rows;
}

void check_sky(Sky& sky, const Refuse& refuse) {
    if (sky.kind != SkyKind::sun) return;
    sky.direction = unit_vector(sky.direction, "direction", refuse);
    if (sky.direction.y > 0)
        refuse("direction", "the sun's light travels downwards: its second number is 0 at most");
}

}  // namespace voxelume
