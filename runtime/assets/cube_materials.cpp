// SPDX-License-Identifier: Apache-2.0
#include "runtime/assets/cube_materials.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "runtime/io/image/png.hpp"

namespace voxelume {
namespace {

uint32_t color_code(const glm::vec3& linear) {
    return uint32_t(srgb_code(linear.r)) | uint32_t(srgb_code(linear.g)) << 8 |
           uint32_t(srgb_code(linear.b)) << 16;
}

/// The roughness whose highlight is as wide as that of Blinn and Phong's exponent.
float roughness_of(const Material& m) {
    if (is_physical(m)) return float(m.roughness.value_or(0.5));
    return float(std::pow(2 / (double(m.shininess) + 2), 0.25));
}

/// The material of a voxel that emits light; the voxel's colour is that of the light.
CubeMaterial emissive(const Material& m) {
    const float largest = std::max({m.emission.r, m.emission.g, m.emission.b});
    CubeMaterial emissive;
    emissive.vox.kind = VoxMaterialKind::emit;
    emissive.vox.weight = std::min(largest, 1.0F);
    const float flux = std::sqrt(largest / emissive.vox.weight) - 1;
    emissive.vox.flux = std::clamp(flux, 0.0F, kMaxFlux);
    emissive.vox.is_flux_cut = flux > kMaxFlux;
    emissive.color = color_code(m.emission / largest);
    return emissive;
}

/// The material of a voxel of glass: light has the voxels' colour after eight voxels.
CubeMaterial glass(const Material& m, double edge) {
    const float weight = float(m.transmission.value_or(double(m.refraction)));
    const glm::vec3 through = glm::exp(m.absorption * float(-8 * edge) / weight);
    CubeMaterial glass;
    glass.vox.kind = VoxMaterialKind::glass;
    glass.vox.weight = weight;
    glass.vox.rough = is_physical(m) ? roughness_of(m) : 0;
    glass.vox.ior = std::clamp(m.ior, 1.0F, 3.0F);
    glass.color = color_code(is_physical(m) ? color_of(m) * through : through);
    return glass;
}

CubeMaterial metal(const Material& m, double weight) {
    CubeMaterial metal;
    metal.vox.kind = VoxMaterialKind::metal;
    metal.vox.weight = float(weight);
    metal.vox.rough = roughness_of(m);
    return metal;
}

CubeMaterial cube_material(const Material& m, double edge) {
    if (m.emission != glm::vec3(0)) return emissive(m);
    if (m.transmission.value_or(0) > 0 || m.refraction > 0) return glass(m, edge);
    const double mirrors = is_physical(m) ? m.metallic.value_or(0) : double(m.reflection);
    if (mirrors > 0) return metal(m, mirrors);
    return {};
}

}  // namespace

std::vector<CubeMaterial> cube_materials(std::span<const Material> materials, double edge) {
    std::vector<CubeMaterial> cubes;
    cubes.reserve(materials.size());
    for (const Material& material : materials) cubes.push_back(cube_material(material, edge));
    return cubes;
}

bool has_more_than_colors(std::span<const CubeMaterial> materials) {
    return std::ranges::any_of(materials, [](const CubeMaterial& material) {
        return material.vox.kind != VoxMaterialKind::diffuse;
    });
}

}  // namespace voxelume
