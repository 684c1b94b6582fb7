// SPDX-License-Identifier: Apache-2.0
#include "runtime/import/gltf_values.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "runtime/import/contents.hpp"
#include "runtime/import/gloss.hpp"
#include "runtime/io/gltf/gltf_texture_use.hpp"

namespace voxelume {
namespace {

glm::dvec3 color_of(const GltfValue& value, const char* key, size_t count) {
    const std::vector<double> numbers = value.numbers(key, count);
    if (numbers.empty()) return glm::dvec3(1);
    return glm::clamp(glm::dvec3(numbers[0], numbers[1], numbers[2]), 0.0, 1.0);
}

/// The values of a material, from either of the two ways in which files describe it.
struct Looks {
    glm::dvec3 color{1};
    double opacity = 1, metal = 1, rough = 1;
};

Looks looks_of(const GltfValue& material) {
    Looks s;
    const char* const kOld = "KHR_materials_pbrSpecularGlossiness";
    const bool is_old = material.has_extension(kOld) &&
                        !material.at("pbrMetallicRoughness").has("baseColorFactor") &&
                        !material.at("pbrMetallicRoughness").has("baseColorTexture");
    const GltfValue from = is_old ? material.extension(kOld) : material.at("pbrMetallicRoughness");
    const char* const color = is_old ? "diffuseFactor" : "baseColorFactor";
    s.color = color_of(from, color, 4);
    const std::vector<double> numbers = from.numbers(color, 4);
    if (!numbers.empty()) s.opacity = std::clamp(numbers[3], 0.0, 1.0);
    if (is_old) {
        s.metal = 0;
        s.rough = 1 - std::clamp(from.number("glossinessFactor", 1), 0.0, 1.0);
    } else {
        // Where a texture that isn't shown decides how much is metal, the factor is meaningless for
        // most of the surface.
        const bool has_map = from.has("metallicRoughnessTexture") && !gltf_has_gloss_map(material);
        s.metal = has_map ? 0 : std::clamp(from.number("metallicFactor", 1), 0.0, 1.0);
        s.rough = has_map ? 0.7 : std::clamp(from.number("roughnessFactor", 1), 0.0, 1.0);
    }
    const std::string mode = material.text("alphaMode", "OPAQUE");
    if (mode == "MASK") s.opacity = s.opacity < material.number("alphaCutoff", 0.5) ? 0 : 1;
    if (mode == "OPAQUE") s.opacity = 1;
    return s;
}

double transmission_of(const GltfValue& material) {
    return std::clamp(
        material.extension("KHR_materials_transmission").number("transmissionFactor", 0), 0.0, 1.0);
}

bool has_volume(const GltfValue& material) {
    return material.extension("KHR_materials_volume").number("thicknessFactor", 0) > 0;
}

/// The index of refraction of a clear coat, unless it is that of glass.
std::string ior_member(const GltfValue& material) {
    const double ior = material.extension("KHR_materials_ior").number("ior", 1.5);
    if (ior == 1.5 || !(ior >= 1)) return "";
    return fmt::format(", \"ior\": {}", rounded(std::min(ior, 10.0), 4));
}

/// A factor between 0 and 1 of an extension, `otherwise` without one or where a texture decides:
/// the factor is then meaningless for most of the surface.
double factor_of(const GltfValue& extension, const std::string& name, double otherwise) {
    if (extension.has((name + "Texture").c_str())) return otherwise;
    return std::clamp(extension.number((name + "Factor").c_str(), otherwise), 0.0, 1.0);
}

/// The keys of a coat, and of a surface that reflects less than its index of refraction implies.
std::string layer_members(const GltfValue& material) {
    std::string text;
    const double specular = factor_of(material.extension("KHR_materials_specular"), "specular", 1);
    if (specular < 1) text += fmt::format(", \"specular\": {}", rounded(specular, 3));
    const GltfValue coat = material.extension("KHR_materials_clearcoat");
    const double share = factor_of(coat, "clearcoat", 0);
    if (share == 0) return text;
    const double rough = factor_of(coat, "clearcoatRoughness", 0);
    return text + fmt::format(", \"coat\": {}, \"coat_roughness\": {}", rounded(share, 3),
                              rounded(rough, 3));
}

/// The keys of a body of glass. A body without volume is a pane, through which light goes straight
/// on.
std::string glass_members(const GltfValue& material, const Looks& s, double transmission,
                          double scale) {
    if (!has_volume(material))
        return fmt::format(", \"opacity\": {}", rounded(std::max(1 - transmission, 0.05), 3));
    std::string text =
        fmt::format(", {}, \"transmission\": {}{}{}", metal_members(s.metal, s.rough),
                    rounded(transmission, 3), ior_member(material), layer_members(material));
    const GltfValue volume = material.extension("KHR_materials_volume");
    const double distance = scale * volume.number("attenuationDistance", 0);
    if (!volume.has("attenuationColor") || !(distance > 0)) return text;
    constexpr double kDarkest = 1e-3;
    const glm::dvec3 left = glm::max(color_of(volume, "attenuationColor", 3), glm::dvec3(kDarkest));
    return text +
           fmt::format(", \"absorption\": {}", json_list(rounded(-glm::log(left) / distance, 4)));
}

glm::dvec3 emission_of(const GltfValue& material) {
    if (!material.has("emissiveFactor")) return glm::dvec3(0);
    const double strength =
        material.extension("KHR_materials_emissive_strength").number("emissiveStrength", 1);
    return color_of(material, "emissiveFactor", 3) * std::clamp(strength, 0.0, 1e6);
}

}  // namespace

bool gltf_transmits(const GltfValue& material) {
    return looks_of(material).opacity < 1 || transmission_of(material) > 0;
}

bool gltf_has_color(const GltfValue& material) {
    return rounded(looks_of(material).color, 4) != glm::dvec3(0);
}

bool gltf_shines(const GltfValue& material) {
    return emission_of(material) != glm::dvec3(0);
}

std::string gltf_values(const GltfValue& material, bool is_unlit, double scale) {
    const Looks s = looks_of(material);
    const std::string opacity =
        s.opacity < 1 ? fmt::format(", \"opacity\": {}", rounded(s.opacity, 3)) : "";
    if (is_unlit)
        return fmt::format("\"color\": [0, 0, 0], \"specular\": 0, \"emission\": {}{}",
                           json_list(rounded(s.color, 4)), opacity);
    const double transmission = transmission_of(material);
    std::string text = fmt::format("\"color\": {}", json_list(rounded(s.color, 4)));
    if (transmission > 0) {
        text += glass_members(material, s, transmission, scale);
    } else if (material.has_extension("KHR_materials_unlit")) {
        // Unlit materials are matt: the colours of vertices don't multiply emission.
    } else {
        text +=
            ", " + metal_members(s.metal, s.rough) + ior_member(material) + layer_members(material);
    }
    if (transmission == 0) text += opacity;
    const glm::dvec3 emission = emission_of(material);
    if (emission != glm::dvec3(0))
        text += fmt::format(", \"emission\": {}", json_list(rounded(emission, 4)));
    return text;
}

}  // namespace voxelume
