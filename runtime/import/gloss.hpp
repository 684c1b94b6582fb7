// SPDX-License-Identifier: Apache-2.0
// The roughness and metals of other programs -> highlights of this one.
#pragma once

#include <string>

namespace voxelume {

/// The exponent of a highlight as wide as that of a surface of this roughness, 0..1.
double shininess_of(double rough);

/// Members of a material, `"metallic": ..., "roughness": ...`, each a share of 0..1.
std::string metal_members(double metal, double rough);

}  // namespace voxelume
