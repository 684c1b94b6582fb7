// SPDX-License-Identifier: Apache-2.0
// Vectors and matrices between the library's inside and its callers.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "runtime/voxelume/values.hpp"

namespace voxelume::api {

inline v1::Vec3 array_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

inline std::array<int, 3> array_of(const glm::ivec3& v) {
    return {v.x, v.y, v.z};
}

inline v1::Size array_of(const glm::ivec2& v) {
    return {v.x, v.y};
}

inline glm::ivec2 vector_of(const v1::Size& size) {
    return {size[0], size[1]};
}

/// The upper three rows of a matrix, which glm stores by columns.
inline v1::Matrix rows_of(const glm::dmat4& m) {
    v1::Matrix rows{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            rows[size_t(row)][size_t(column)] = m[column][row];
    return rows;
}

}  // namespace voxelume::api
