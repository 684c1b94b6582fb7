// SPDX-License-Identifier: Apache-2.0
// The rays and meshes of bench_trace.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/grid/grid_frame.hpp"

namespace voxelume {

/// A ray in the pyramid's voxels.
struct Ray {
    glm::dvec3 origin, direction;
    float end = INFINITY;
};

struct Hit {
    bool met = false;
    float t = 0;
    glm::dvec3 at{0};
};

constexpr int kPictureSide = 1024;  ///< pixels
constexpr glm::dvec3 kLightPosition{1.5, 2.5, 2};

/// All rays of the picture in 4 x 4 tiles, from the grid's box on. Rays that miss the box have an
/// end of -1.
std::vector<Ray> picture_rays(const GridFrame& frame);

/// The rays of `rays` that hit something, and rays from their hits: bounces and shadow rays start
/// two voxels back towards the eye, on the outside.
struct RayLists {
    std::vector<Ray> hitting, shadow, bounce;
};

RayLists split_rays(const std::vector<Ray>& rays, const std::vector<Hit>& hits,
                    const GridFrame& frame);

/// A mesh file's mesh with its longest side 1, centred at the origin.
Mesh scaled_mesh(const char* path);

/// The mesh with each triangle cut into four, between its corners and the middles of its edges.
Mesh halved(const Mesh& mesh);

}  // namespace voxelume
