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
    return fmt::format("\"metallic\": {}, \"roughness\": {}", rounded(metal, 3), rounded(rough, 3));
}

}  // namespace voxelume
