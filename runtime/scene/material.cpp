// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/material.hpp"

#include <array>

namespace voxelume {

std::span<const ValueRow<Material>> material_rows() {
    using M = Material;
    static constexpr std::array<ValueRow<Material>, 11> rows = {{
        {"color", &M::color, kRatio},
        {"diffuse", &M::diffuse, kRatio},
        {"specular", &M::specular, kRatio},
        {"shininess", &M::shininess, {1, 1e6}},
        {"reflection", &M::reflection, kRatio, false, true, kReflects},
        {"refraction", &M::refraction, kRatio, false, true, kRefracts},
        {"ior", &M::ior, {0.1, 10}},
        {"fresnel", &M::fresnel, {}, false, true, kHasReflectance},
        {"opacity", &M::opacity, kRatio, false, true, kIsSeenThrough},
        {"absorption", &M::absorption, kNotNegative, false, true, kAbsorbs},
        {"emission", &M::emission, kNotNegative, false, true, kEmits},
    }};
    return rows;
}

std::span<const ValueRow<Checker>> checker_rows() {
    static constexpr std::array<ValueRow<Checker>, 3> rows = {{
        {"color", &Checker::color, kRatio},
        {"size", &Checker::size, kNotNegative, true},
        {"origin", &Checker::origin, kCoordinate},
    }};
    return rows;
}

uint32_t effects_of(const Material& material) {
    static const Material plain;
    uint32_t effects = 0;
    for (const ValueRow<Material>& row : material_rows())
        if (row.effect != 0 && !row.is_equal(material, plain)) effects |= row.effect;
    return effects;
}

void check_checker(const Checker& checker, const Refuse& refuse) {
    if (checker.size == glm::dvec3(0)) refuse("", "needs a size above 0 along some axis");
}

}  // namespace voxelume
