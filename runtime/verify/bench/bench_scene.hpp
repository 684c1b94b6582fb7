// SPDX-License-Identifier: Apache-2.0
// The scenes of `voxelume bench` that show one object, which the observer sees whole.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// A solid about a metre wide and near the origin, turned and shifted off the world's lattice.
struct BenchSolid {
    const char* name;
    const char* help;
    Solid solid;
    double min_radius;            ///< minimum radius of curvature, metres; 0 for edges
    glm::dmat4 world_from_solid;  ///< turns and shifts
};

std::span<const BenchSolid> bench_solids();

/// A world in voxels of 1/`resolution` metres for an object that extends at most 0.55 m from the
/// origin on each axis, and an observer 2.4 m away who sees all of it. It has no objects and no
/// lights.
Scene empty_bench_scene(int resolution, glm::ivec2 size);

/// Adds a model in voxels of 1/`resolution` metres of the world, and the scene's only object.
/// `placement` turns, shifts and scales equally on all axes.
void add_bench_object(Scene& scene, Model model, Surface surface, int resolution,
                      const glm::dmat4& placement);

/// The scene of a solid in voxels of 1/`resolution` metres, seen by one ray per pixel, without
/// lights.
Scene bench_scene(const BenchSolid& solid, Surface surface, int resolution, glm::ivec2 size);

/// The unit vector from the observer through a point of the image. The point is in pixels from the
/// upper left corner.
glm::dvec3 sight_direction(const Scene& scene, double column, double row);

}  // namespace voxelume
