// SPDX-License-Identifier: Apache-2.0
// How rough surfaces and metals of other programs shine here: highlights and sharp mirrors.
#pragma once

#include <string>

namespace voxelume {

/// The exponent of a highlight as wide as that of a surface of this roughness, 0..1.
double shininess_of(double rough);

/// Members of a material: `"diffuse": ..., "specular": ..., "shininess": ..., "reflection": ...` of
/// a surface that is metal by a share of 0..1. Mirrors are sharp and colourless, so a rough metal
/// reflects less and shows more of its own colour.
std::string metal_members(double metal, double rough);

}  // namespace voxelume
