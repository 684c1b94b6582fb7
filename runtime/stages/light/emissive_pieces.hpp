// SPDX-License-Identifier: Apache-2.0
// a world's emissive objects -> the pieces of surface that emit their light.
#pragma once

#include <map>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/light/light_sample_choice.hpp"

namespace voxelume {

/// The area in square metres of the plane through `point` perpendicular to `gradient`, within a
/// voxel whose edges are `edge` metres. `point` and `gradient` are in voxels.
double area_in_voxel(const glm::dvec3& point, const glm::dvec3& gradient, const glm::dvec3& edge);

/// The pieces of each emissive object: an open face of a cube, the part of a smooth surface or an
/// exact solid in a voxel, a triangle or its parts. A closed mesh emits outwards, an open one to
/// both sides.
///
/// `is_emissive` has a value per object. Pieces of cubes and voxels come first, in the order of
/// their places, then those of triangles, in the order of the mesh.
std::map<uint32_t, std::vector<EmissivePiece>> emissive_pieces(
    const Device& device, const Features& features, const Scene& scene, const Pyramid& world,
    const std::vector<uint32_t>& is_emissive);

/// Adds only the triangles of the emissive objects.
void add_emissive_triangles(const Scene& scene, const Pyramid& world,
                            const std::vector<uint32_t>& is_emissive,
                            std::map<uint32_t, std::vector<EmissivePiece>>& pieces);

}  // namespace voxelume
