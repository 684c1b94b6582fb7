// SPDX-License-Identifier: Apache-2.0
#include "runtime/import/gloss.hpp"

#include <algorithm>

#include "runtime/import/contents.hpp"

namespace voxelume {

double shininess_of(double rough) {
    const double squared = std::max(rough * rough, 0.04);
    return rounded(std::clamp(2 / (squared * squared) - 2, 2.0, 1000.0), 3);
}

std::string metal_members(double metal, double rough) {
    const double smooth = (1 - rough) * (1 - rough);
    return fmt::format("\"diffuse\": {}, \"specular\": {}, \"shininess\": {}, \"reflection\": {}",
                       rounded(1 - 0.5 * metal * smooth, 3), rounded(0.6 * metal, 3),
                       shininess_of(rough), rounded(0.65 * metal * smooth, 3));
}

}  // namespace voxelume
