// SPDX-License-Identifier: Apache-2.0
// The flat image of a scene of analytic solids, with the pixels at which a comparison isn't
// meaningful.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/scene/scene.hpp"

namespace voxelume::oracle {

/// `width` x `height` values, row 0 at the top, x fastest.
struct AnalyticImage {
    int width = 0;
    int height = 0;
    std::vector<glm::dvec3> radiance;
    std::vector<uint8_t> edge;  ///< 1 if the way to the pixel had another decision than the way to
                                ///< one of its eight neighbours, so that rounding may decide
};

/// Traces one sight ray through each pixel's centre. Throws std::invalid_argument for displays
/// other than pyramids and for objects that AnalyticTracer refuses.
AnalyticImage analytic_image(const Scene& scene);

}  // namespace voxelume::oracle
