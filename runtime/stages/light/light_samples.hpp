// lights with an area -> the light samples that stand for them.
#pragma once

#include <vector>

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// Whether an object's emission lights the world: the paper's source of many light samples.
bool is_emissive(const Scene& scene, const Object& object);

/// The light samples that an emissive object of so many square metres has when the scene doesn't
/// say: one for each square of four voxels' edges, but at least 16 and at most 128.
int default_light_samples(double area, const glm::dvec3& voxel_edge);

/// The light samples of a disk or rectangle: `light.light_samples` equal parts of its area and
/// energy. A disk's lie on Vogel's spiral, a rectangle's in the middles of boxes that share it
/// evenly.
std::vector<LightRecord> area_light_samples(const Light& light, const GridFrame& world);

/// The light samples of all emissive objects, in the order of the objects: each one's surface in
/// the world, found voxel by voxel, divided into parts that lie together and face alike.
///
/// A light sample has its part's whole area and emission; it stands a little above a point of the
/// surface, so that a ray that ends there is clear of it (kLightSampleOffset). Surfaces that lie in
/// the world's sides and face outwards have none. The same on every device. The kernels are
/// compiled here, so call it only for a scene with emissive objects. Throws Error::limit when the
/// device's memory doesn't suffice.
std::vector<LightRecord> emissive_light_samples(const Device& device, const Features& features,
                                                const Scene& scene, const Pyramid& world);

}  // namespace voxelume
