// SPDX-License-Identifier: Apache-2.0
#include "runtime/import/mtl_values.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/import/contents.hpp"
#include "runtime/import/gloss.hpp"
#include "runtime/io/mesh/mesh_color.hpp"

namespace voxelume {
namespace {

/// True for models of illumination in which reflected rays are traced; refracts() is true for those
/// with refracted rays.
bool reflects(int illumination) {
    return illumination >= 3 && illumination <= 7;
}

bool refracts(int illumination) {
    return illumination == 6 || illumination == 7;
}

glm::dvec3 linear_color(const glm::dvec3& srgb) {
    return linear_from_srgb(glm::clamp(srgb, 0.0, 1.0));
}

/// The base colour. Files with a texture of colours may have black in Kd, which counts as white.
glm::dvec3 color_of(const MtlMaterial& m) {
    const bool is_left_out = !m.diffuse_map.file.empty() && m.diffuse == glm::dvec3(0);
    return is_left_out ? glm::dvec3(1) : linear_color(m.diffuse);
}

/// The opacity of a material. Programs disagree on which end of Tr is opaque, and nobody writes a
/// material to be invisible, so 0 counts as opaque.
double opacity_of(const MtlMaterial& m) {
    const double opacity = std::clamp(m.opacity, 0.0, 1.0);
    return opacity > 0 ? opacity : 1;
}

/// The emission of a material. Files with a texture of emission may have black in Ke, which counts
/// as white.
glm::dvec3 emission_of(const MtlMaterial& m) {
    const bool is_left_out = !m.emission_map.file.empty() && m.emission == glm::dvec3(0);
    return is_left_out ? glm::dvec3(1) : linear_color(m.emission);
}

/// The roughness and metalness. Where there is a map, its number is 1: programs that write both
/// mean the map alone.
std::string physical_members(const MtlMaterial& m) {
    const auto value = [](const std::optional<double>& number, const MtlTexture& map,
                          double otherwise) {
        return map.file.empty() ? std::clamp(number.value_or(otherwise), 0.0, 1.0) : 1.0;
    };
    return ", " + metal_members(value(m.metallic, m.metallic_map, 0),
                                value(m.roughness, m.roughness_map, kRoughness));
}

double mean(const glm::dvec3& v) {
    return std::clamp((v.x + v.y + v.z) / 3, 0.0, 1.0);
}

}  // namespace

bool mtl_transmits(const MtlMaterial& m) {
    return opacity_of(m) < 1;
}

std::string mtl_values(const MtlMaterial& m) {
    const double opacity = opacity_of(m), mirror = mean(linear_color(m.specular));
    std::string text = fmt::format("\"color\": {}", json_list(rounded(color_of(m), 4)));
    // Highlights of a lower exponent would cover the whole surface.
    if (!m.is_physical() && m.illumination >= 2 && m.exponent >= 2 && mirror > 0)
        text += fmt::format(", \"specular\": {}, \"shininess\": {}", rounded(mirror, 3),
                            rounded(std::clamp(m.exponent, 1.0, 1e6), 4));
    const bool is_glass = opacity < 1 && refracts(m.illumination);
    if (is_glass)
        text += fmt::format(
            ", \"diffuse\": {}, \"reflection\": 1, \"refraction\": {}, \"ior\": {}, "
            "\"fresnel\": true",
            rounded(opacity, 3), rounded(1 - opacity, 3), rounded(std::clamp(m.ior, 1.0, 10.0), 4));
    else if (!m.is_physical() && reflects(m.illumination) && mirror > 0)
        text += fmt::format(", \"reflection\": {}", rounded(mirror, 3));
    if (opacity < 1 && !is_glass) text += fmt::format(", \"opacity\": {}", rounded(opacity, 3));
    if (!is_glass && m.is_physical()) text += physical_members(m);
    const glm::dvec3 emission = emission_of(m);
    if (emission != glm::dvec3(0))
        text += fmt::format(", \"emission\": {}", json_list(rounded(emission, 4)));
    return text;
}

}  // namespace voxelume
