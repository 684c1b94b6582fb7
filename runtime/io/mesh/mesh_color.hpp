// SPDX-License-Identifier: Apache-2.0
// Colours of mesh files -> linear Rec. 709.
#pragma once

#include <glm/vec3.hpp>

#include "runtime/image/srgb.hpp"

namespace voxelume {

/// The linear value of an sRGB value in [0, 1] (IEC 61966-2-1), rounded once from double.
inline float linear_from_srgb(double value) {
    return static_cast<float>(srgb_to_linear(value));
}

/// The linear Rec. 709 colour of an sRGB colour. Mesh formats don't say what their colours mean.
/// Scanners and modellers write what a screen shows, so every reader takes the colours as sRGB.
inline glm::vec3 linear_from_srgb(const glm::dvec3& color) {
    return {linear_from_srgb(color.x), linear_from_srgb(color.y), linear_from_srgb(color.z)};
}

}  // namespace voxelume
