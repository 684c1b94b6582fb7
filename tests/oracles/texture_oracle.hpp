// SPDX-License-Identifier: Apache-2.0
// The colours of a picture on a surface, in double precision: bilinear values in linear light.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace voxelume::oracle {

enum class Beyond { repeat, mirror, clamp };

/// Texels of a picture, from its upper left corner on, in sRGB.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::array<uint8_t, 3>> texels;
    Beyond beyond_u = Beyond::repeat, beyond_v = Beyond::repeat;
};

/// The linear light of an sRGB code.
double linear_light(double code);

/// The bilinear value at a point, in picture widths from the upper left corner.
glm::dvec3 bilinear(const Picture& picture, const glm::dvec2& place);

}  // namespace voxelume::oracle
