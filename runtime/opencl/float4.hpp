// Vectors as kernels' records hold them.
#pragma once

#include <glm/vec3.hpp>

#include "kernels/shared/scene.h"

namespace voxelume {

/// Rounded to float; w is 0.
inline float4 to_float4(const glm::dvec3& v) {
    return {float(v.x), float(v.y), float(v.z), 0};
}

}  // namespace voxelume
