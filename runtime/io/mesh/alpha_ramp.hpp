// SPDX-License-Identifier: Apache-2.0
// The alpha of vertices as places on a texture: a row of white texels that cover more and more.
// Between corners the place, and so the alpha, is linear, as colours are.
#pragma once

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/io/mesh/texture_levels.hpp"

namespace voxelume {

/// The texture, whose alpha means `alpha` (of Texture).
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

/// The place on it of an alpha from 0 to 1, which is 1 for what is no number.
inline glm::vec2 place_on_ramp(double alpha) {
    const double share = std::isfinite(alpha) ? std::clamp(alpha, 0.0, 1.0) : 1;
    return {float((255 * share + 0.5) / 256), 0.5f};
}

/// True if vertices of these alphas let light through. Where all are 0, nobody meant them.
inline bool lets_through(const std::vector<float>& alphas) {
    return std::ranges::any_of(alphas, [](float a) { return a < 1; }) &&
           std::ranges::any_of(alphas, [](float a) { return a > 0; });
}

/// Gives a mesh the alphas of its vertices, one each, or a note if a texture has their places.
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
