// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/material.hpp"

#include <algorithm>
#include <array>

namespace voxelume {

std::span<const ValueRow<Material>> material_rows() {
    using M = Material;
    static constexpr std::array<ValueRow<Material>, 17> rows = {{
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
        {"base_color", &M::base_color, kRatio, false, true, kIsPhysical},
        {"metallic", &M::metallic, kRatio, false, true, kIsPhysical},
        {"roughness", &M::roughness, kRatio, false, true, kIsPhysical},
        {"transmission", &M::transmission, kRatio, false, true, kIsPhysical},
        {"coat", &M::coat, kRatio, false, true, kIsPhysical},
        {"coat_roughness", &M::coat_roughness, kRatio, false, true, kIsPhysical},
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
    if ((effects & kIsPhysical) != 0 && whitted_material(material).reflection > 0)
        effects |= kReflects;
    if (glass_share(material) > 0) effects |= kRefracts | kHasReflectance;
    if (material.coat.value_or(0) > 0) effects |= kHasCoat;
    return effects;
}

bool is_physical(const Material& material) {
    return material.base_color || material.metallic || material.roughness ||
           material.transmission || material.coat || material.coat_roughness;
}

bool shows_lights(const Material& material) {
    return (effects_of(material) & (kReflects | kRefracts | kIsPhysical)) != 0;
}

bool is_weak(const Material& material) {
    return is_physical(material) && material.specular.value_or(1) < 1;
}

double glass_share(const Material& material) {
    return material.transmission.value_or(0) * (1 - material.metallic.value_or(0));
}

bool takes_gloss_map(const Material& material) {
    return is_physical(material) && glass_share(material) == 0 && material.coat.value_or(0) == 0;
}

bool maps_make_mirrors(const Material& material) {
    return takes_gloss_map(material) && material.metallic.value_or(0) > 0;
}

glm::vec3 color_of(const Material& material) {
    return material.base_color ? glm::vec3(*material.base_color) : material.color;
}

namespace {

/// The exponent of a highlight about as wide as that of rough facets.
float shininess_of(double rough) {
    const double width = std::max(rough * rough, 0.04);
    return float(std::clamp(2 / (width * width) - 2, 2.0, 1000.0));
}

/// The parts of the light that a surface of metal, or of clear facets over matt ones, reflects in
/// local light.
struct LocalGloss {
    double metal, rough, mirror;       ///< `mirror`: part of the metal's reflection
    double of_metal, of_facets, coat;  ///< strengths of highlights

    explicit LocalGloss(const Material& material)
        : metal(material.metallic.value_or(0)),
          rough(material.roughness.value_or(kRoughness)),
          mirror((1 - rough) * (1 - rough)),
          of_metal(metal * (1 - 0.4 * rough)) {
        constexpr double kGlint = 0.2;  // the root of what glass reflects straight on
        of_facets = kGlint * material.specular.value_or(1) * (1 - metal) * (1 - rough);
        coat = kGlint * material.coat.value_or(0) *
               (1 - material.coat_roughness.value_or(kCoatRoughness));
    }

    bool shows_coat() const { return coat > of_metal + of_facets; }
    /// The part that metal neither mirrors nor returns in its highlight, whose light is about 8 /
    /// (n + 7.6) for an exponent n. It approximates the reflection of all surroundings in rough
    /// metal.
    double spread() const {
        const double highlight = (1 - 0.4 * rough) * 8 / (double(shininess_of(rough)) + 7.6);
        return std::max(1 - mirror - highlight, 0.0);
    }
};

}  // namespace

Material whitted_material(const Material& material) {
    if (!is_physical(material)) return material;
    const LocalGloss gloss(material);
    const double glass = glass_share(material);
    Material m = material;
    m.color = color_of(material);
    drop_physical(m);
    m.diffuse = float(1 - gloss.metal * (1 - gloss.spread()) - glass);
    m.specular = std::max(gloss.of_metal + gloss.of_facets, gloss.coat);
    m.shininess = shininess_of(gloss.shows_coat() ? material.coat_roughness.value_or(kCoatRoughness)
                                                  : gloss.rough);
    m.reflection = float(gloss.metal * gloss.mirror + glass);
    if (glass == 0) return m;
    m.refraction = float(glass);
    m.fresnel = true;
    return m;
}

MetalTint metal_tint(const Material& material) {
    if (!is_physical(material)) return {};
    const LocalGloss gloss(material);
    const auto share = [](double part, double rest) { return part > 0 ? part / (part + rest) : 0; };
    return {gloss.shows_coat() ? 0 : share(gloss.of_metal, gloss.of_facets),
            share(gloss.metal * gloss.mirror, glass_share(material))};
}

void drop_physical(Material& material) {
    material.base_color.reset();
    material.metallic.reset();
    material.roughness.reset();
    material.transmission.reset();
    material.coat.reset();
    material.coat_roughness.reset();
}

std::span<const std::string_view> physical_keys() {
    static constexpr std::array<std::string_view, 6> keys = {
        "base_color", "metallic", "roughness", "transmission", "coat", "coat_roughness"};
    return keys;
}

std::span<const std::string_view> whitted_keys() {
    static constexpr std::array<std::string_view, 5> keys = {"diffuse", "shininess", "reflection",
                                                             "refraction", "fresnel"};
    return keys;
}

void check_checker(const Checker& checker, const Refuse& refuse) {
    if (checker.size == glm::dvec3(0)) refuse("", "needs a size above 0 along some axis");
}

}  // namespace voxelume
