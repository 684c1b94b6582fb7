// a world's emitting objects -> the pieces of surface that they shine with.
#pragma once

#include <map>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/light/spot_choice.hpp"

namespace voxelume {

/// The area in square metres that the plane through `point` across `gradient` has in the unit
/// cube, whose edges are `edge` metres. Both vectors in voxels.
double area_in_voxel(const glm::dvec3& point, const glm::dvec3& gradient, const glm::dvec3& edge);

/// The pieces of each lamp: an open face of a cube, what a smooth surface or an exact solid has in
/// a voxel, a triangle or its parts. A closed mesh shines outwards, an open one to both sides.
///
/// `is_lamp` has a value per object. Pieces of cubes and voxels are in the order of their places,
/// those of triangles in the order of the mesh, after them.
std::map<uint32_t, std::vector<GlowingPiece>> glowing_pieces(const Device& device,
                                                             const Features& features,
                                                             const Scene& scene,
                                                             const Pyramid& world,
                                                             const std::vector<uint32_t>& is_lamp);

/// The triangles of the lamps alone.
void add_glowing_triangles(const Scene& scene, const Pyramid& world,
                           const std::vector<uint32_t>& is_lamp,
                           std::map<uint32_t, std::vector<GlowingPiece>>& pieces);

}  // namespace voxelume
