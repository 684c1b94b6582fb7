// lights with an area -> the spots that stand for them.
#pragma once

#include <vector>

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// Whether an object's emission lights the world: the paper's source of many spots.
bool is_lamp(const Scene& scene, const Object& object);

/// The spots that a lamp of so many square metres has when the scene doesn't say: one for each
/// square of four voxels' edges, but at least 16 and at most 128.
int default_spots(double area, const glm::dvec3& voxel_edge);

/// The spots of a disk or rectangle: `light.spots` equal parts of its area and energy. A disk's lie
/// on Vogel's spiral, a rectangle's in the middles of boxes that share it evenly.
std::vector<LightRecord> area_spots(const Light& light, const GridFrame& world);

/// The spots of all lamps, in the order of the objects: each one's surface in the world, found
/// voxel by voxel, divided into parts that lie together and face alike.
///
/// A spot has its part's whole area and emission; it stands a little above a point of the
/// surface, so that a ray that ends there is clear of it (kSpotLift). Surfaces that lie in the
/// world's sides and face outwards have none. The same on every device. The kernels are compiled
/// here, so call it only for a scene with lamps. Throws Error::limit when the device's memory
/// doesn't suffice.
std::vector<LightRecord> lamp_spots(const Device& device, const Features& features,
                                    const Scene& scene, const Pyramid& world);

}  // namespace voxelume
