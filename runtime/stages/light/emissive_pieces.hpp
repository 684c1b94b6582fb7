// a world's emitting objects -> the pieces of surface that they shine with.
#pragma once

#include <map>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/light/light_sample_choice.hpp"

namespace voxelume {

/// The area in square metres that the plane through `point` across `gradient` has in the unit
/// cube, whose edges are `edge` metres. Both vectors in voxels.
double area_in_voxel(const glm::dvec3& point, const glm::dvec3& gradient, const glm::dvec3& edge);

/// The pieces of each emissive object: an open face of a cube, what a smooth surface or an exact
/// solid has in a voxel, a triangle or its parts. A closed mesh shines outwards, an open one to
/// both sides.
///
/// `is_emissive` has a value per object. Pieces of cubes and voxels are in the order of their
/// places, those of triangles in the order of the mesh, after them.
std::map<uint32_t, std::vector<EmissivePiece>> emissive_pieces(
    const Device& device, const Features& features, const Scene& scene, const Pyramid& world,
    const std::vector<uint32_t>& is_emissive);

/// The triangles of the emissive objects alone.
void add_emissive_triangles(const Scene& scene, const Pyramid& world,
                            const std::vector<uint32_t>& is_emissive,
                            std::map<uint32_t, std::vector<EmissivePiece>>& pieces);

}  // namespace voxelume
