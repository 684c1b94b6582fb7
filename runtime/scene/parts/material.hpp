// SPDX-License-Identifier: Apache-2.0
// The look of a surface: the values of Whitted's model or of a physically based one, and a checker.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "runtime/scene/parts/value_row.hpp"

namespace voxelume {

/// A second colour in every other block of a lattice that is fixed in the world.
struct Checker {
    glm::vec3 color{0};    ///< linear Rec. 709, 0..1
    glm::dvec3 size{0};    ///< edges of a block, metres; 0: no change along that axis
    glm::dvec3 origin{0};  ///< a corner of a block of the material's own colour, metres

    friend bool operator==(const Checker&, const Checker&) = default;
};

/// The roughness of physically based materials that give none, and of their coats.
inline constexpr double kRoughness = 0.5, kCoatRoughness = 0;

struct Material {
    std::string name;
    glm::vec3 color{0.8f};  ///< linear Rec. 709, 0..1
    float diffuse = 1;      ///< 0..1
    /// 0..1: the weight of Blinn and Phong's highlight, 0 by default. For a physically based
    /// material, the factor of the reflectance of its non-metallic part, 1 by default.
    std::optional<double> specular;
    float shininess = 50;     ///< Blinn-Phong exponent, 1..1e6
    float reflection = 0;     ///< R_i, 0..1
    float refraction = 0;     ///< F_i, 0..1
    float ior = 1.5f;         ///< 0.1..10
    bool fresnel = false;     ///< the exact unpolarised reflectance scales the two ratios
    float opacity = 1;        ///< share of the light behind that the surface covers, 0..1
    glm::vec3 absorption{0};  ///< inside, per metre, >= 0
    glm::vec3 emission{0};    ///< radiance, >= 0
    std::optional<Checker> checker;
    // A material with any of these values is physically based:
    std::optional<glm::dvec3> base_color;  ///< 0..1; otherwise `color`
    std::optional<double> metallic;        ///< 0..1; otherwise 0
    std::optional<double> roughness;       ///< 0..1; otherwise 0.5
    std::optional<double> transmission;    ///< share of glass in the non-metallic part, 0..1
    std::optional<double> coat;            ///< the share under a clear coat, 0..1; otherwise 0
    std::optional<double> coat_roughness;  ///< 0..1; otherwise 0

    friend bool operator==(const Material&, const Material&) = default;
};

/// Bits for the effects of a material's values on rays and kernels.
enum MaterialEffect : uint32_t {
    kReflects = 1,        ///< sends rays back
    kRefracts = 2,        ///< sends rays on into the object
    kIsSeenThrough = 4,   ///< covers only a part of what lies behind
    kHasReflectance = 8,  ///< Fresnel reflectance, by the angle
    kAbsorbs = 16,        ///< dims light on its way inside
    kEmits = 32,
    kIsPhysical = 64,  ///< physically based
    kHasCoat = 128,    ///< physically based, with a coat
};

/// The rows of all values of a material except its checker. A new value needs a member above, a row
/// here, and the kernels that show it.
std::span<const ValueRow<Material>> material_rows();
std::span<const ValueRow<Checker>> checker_rows();

/// The effects of the values that differ from the defaults.
uint32_t effects_of(const Material& material);

bool is_physical(const Material& material);

/// True if paths that the surface scatters show lights: mirrors, glass, physically based ones.
bool shows_lights(const Material& material);

/// True if a physically based surface reflects less than its index of refraction implies.
bool is_weak(const Material& material);

/// The share of a physically based surface that is glass.
double glass_share(const Material& material);

/// True if the maps of textures change the material's roughness and metalness. This holds for
/// physically based materials without glass and coat: the tables of these are made for one
/// roughness.
bool takes_gloss_map(const Material& material);

/// True if such maps may turn parts of the material's surface into mirrors in local light.
bool maps_make_mirrors(const Material& material);

/// The surface's own colour, whichever of the two keys names it.
glm::vec3 color_of(const Material& material);

/// A physically based material in Whitted's model, by which local light shows it; other materials
/// are unchanged. Mirrors are sharp in that model, so a rough metal mirrors less, and shows its own
/// colour in place of the blurred reflection of its surroundings.
Material whitted_material(const Material& material);

/// The shares of a material's highlight and mirror image, in local light, that have its colour.
struct MetalTint {
    double highlight = 0, mirror = 0;
};
MetalTint metal_tint(const Material& material);

/// The keys that make a material physically based, and the keys of Whitted's model that they
/// replace.
std::span<const std::string_view> physical_keys();
std::span<const std::string_view> whitted_keys();

/// Leaves a material without the values of `physical_keys`, as if a scene hadn't given them.
void drop_physical(Material& material);

/// Refuses a checker without blocks.
void check_checker(const Checker& checker, const Refuse& refuse);

}  // namespace voxelume
