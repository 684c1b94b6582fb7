// The scenes of `voxelume bench`: one solid each, that an observer sees whole.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "runtime/scene.hpp"

namespace voxelume {

/// About a metre across and near the origin, turned and shifted off the world's lattice.
struct BenchSolid {
    const char* name;
    const char* help;
    Solid solid;
    double least_radius;          ///< of curvature of its surface, metres; 0 for edges
    glm::dmat4 world_from_solid;  ///< turns and shifts
};

std::span<const BenchSolid> bench_solids();

/// The solid in voxels of 1/`resolution` metres, seen by one ray a pixel. There are no lights.
Scene bench_scene(const BenchSolid& solid, Surface surface, int resolution, glm::ivec2 size);

/// The unit vector from the observer through a point of the image, in pixels from its upper left
/// corner.
glm::dvec3 sight_direction(const Scene& scene, double column, double row);

}  // namespace voxelume
