// SPDX-License-Identifier: Apache-2.0
// The alpha of vertices as UVs on a texture: a row of white texels of increasing alpha. Between
// corners the UV, and so the alpha, is linear, as colours are.
#pragma once

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/io/mesh/texture_levels.hpp"

namespace voxelume {

/// The texture of all alphas. `alpha` becomes Texture::alpha.
inline Texture alpha_ramp(uint32_t alpha) {
    Picture row{256, 1, {}};
    for (int i = 0; i < 256; ++i) row.pixels.push_back({255, 255, 255, uint8_t(i)});
    return {std::make_shared<const TextureImage>(with_levels(row)),
            TextureWrap::clamp,
            TextureWrap::clamp,
            alpha,
            {},
            true};
}

/// The UV on this texture of an alpha from 0 to 1; NaN counts as 1.
inline glm::vec2 place_on_ramp(double alpha) {
    const double share = std::isfinite(alpha) ? std::clamp(alpha, 0.0, 1.0) : 1;
    return {float((255 * share + 0.5) / 256), 0.5f};
}

/// True if some alpha is below 1. If all are 0, they count as opaque, because invisible meshes
/// aren't meant.
inline bool lets_through(const std::vector<float>& alphas) {
    return std::ranges::any_of(alphas, [](float a) { return a < 1; }) &&
           std::ranges::any_of(alphas, [](float a) { return a > 0; });
}

/// Shows the alphas of a mesh's vertices, or adds a note if a texture already uses the UVs.
inline void show_vertex_alpha(const std::vector<float>& alphas, bool has_texture, Mesh& mesh) {
    if (!lets_through(alphas)) return;
    if (has_texture) {
        mesh.notes.emplace_back("the alpha of its vertices isn't shown: it has a texture");
        return;
    }
    mesh.uvs.clear();
    for (const float alpha : alphas) mesh.uvs.push_back(place_on_ramp(alpha));
    mesh.triangle_uvs = {};
    mesh.textures = {alpha_ramp(kAlphaBlend)};
    mesh.group_textures = {0};
}

}  // namespace voxelume
