// SPDX-License-Identifier: Apache-2.0
// Vectors in the form that kernels' records hold.
#pragma once

#include <glm/vec3.hpp>

#include "kernels/shared/scene.h"

namespace voxelume {

/// The vector rounded to float; w is 0.
inline float4 to_float4(const glm::dvec3& v) {
    return {float(v.x), float(v.y), float(v.z), 0};
}

}  // namespace voxelume
