// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/solid.hpp"

#include <algorithm>
#include <array>

namespace voxelume {

bool is_infinite(const Solid& solid) {
    switch (solid.kind) {
        case SolidKind::slab:
            return true;
        case SolidKind::union_of:
            return std::any_of(solid.parts.begin(), solid.parts.end(), is_infinite);
        case SolidKind::intersection_of:
            return std::all_of(solid.parts.begin(), solid.parts.end(), is_infinite);
        case SolidKind::difference_of:
            return is_infinite(solid.parts.front());
        default:
            return false;
    }
}

std::span<const SolidType> solid_types() {
    static constexpr KindKey sphere[] = {{"radius", true}};
    static constexpr KindKey ellipsoid[] = {{"radii", true}};
    static constexpr KindKey box[] = {{"size", true}};
    static constexpr KindKey cylinder[] = {{"radius", true}, {"height", true}};
    static constexpr KindKey cone[] = {{"radius", true}, {"height", true}, {"top_radius"}};
    static constexpr KindKey torus[] = {{"radius", true}, {"tube", true}};
    static constexpr KindKey slab[] = {{"thickness", true}};
    static constexpr KindKey parts[] = {{"parts", true}};
    static constexpr std::array<SolidType, 11> shapes = {{
        {SolidKind::sphere, "sphere", sphere},
        {SolidKind::ellipsoid, "ellipsoid", ellipsoid},
        {SolidKind::box, "box", box},
        {SolidKind::cylinder, "cylinder", cylinder},
        {SolidKind::cone, "cone", cone},
        {SolidKind::torus, "torus", torus},
        {SolidKind::capsule, "capsule", cylinder},
        {SolidKind::slab, "slab", slab},
        {SolidKind::union_of, "union", parts},
        {SolidKind::intersection_of, "intersection", parts},
        {SolidKind::difference_of, "difference", parts},
    }};
    return shapes;
}

std::span<const ValueRow<Solid>> solid_rows() {
    static constexpr std::array<ValueRow<Solid>, 7> rows = {{
        {"radius", &Solid::radius, kLength},
        {"radii", &Solid::radii, kLength},
        {"size", &Solid::size, kLength},
        {"height", &Solid::height, kLength},
        {"tube", &Solid::tube, kLength},
        {"top_radius", &Solid::top_radius, kNotNegative},
        {"thickness", &Solid::thickness, kLength},
    }};
    return rows;
}

void check_solid(const Solid& solid, const Refuse& refuse) {
    if (solid.kind == SolidKind::torus && solid.tube > solid.radius)
        refuse("tube", "must not be larger than the torus's radius");
}

}  // namespace voxelume
