// SPDX-License-Identifier: Apache-2.0
// The light that shows surfaces in the colours of scans.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/scene/parts/light.hpp"

namespace voxelume {

/// The lights of a scan. Nothing casts shadows, and area lights shine from their middles.
struct MediumLights {
    std::vector<Light> lights;
    glm::dvec3 ambient{0};
};

/// The lights of a scan that is lit along one direction: a quarter is ambient.
MediumLights lights_along(const glm::dvec3& direction);

/// The surface in a voxel, estimated from the absorptions of its eighths.
struct MediumSurface {
    glm::dvec3 inward{0};  ///< unit vector along which the absorption rises; 0: none
    double share = 0;      ///< 0..1: the part that counts as a surface; the rest faces every light
};

/// The surface in a voxel with these edges.
MediumSurface medium_surface(const std::array<double, 8>& eighths, const glm::dvec3& edge);

/// The light on a surface at a position in metres.
glm::dvec3 light_on(const MediumSurface& surface, const glm::dvec3& position,
                    const MediumLights& lights);

}  // namespace voxelume
