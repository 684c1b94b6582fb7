// SPDX-License-Identifier: Apache-2.0
// lights with an area -> the light samples that represent them.
#pragma once

#include <vector>

#include "kernels/shared/paths.h"
#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// The number of light samples of an emissive object with `area` square metres, if the scene
/// doesn't say: one for each square of four voxels' edges, but at least 16 and at most 128.
int default_light_samples(double area, const glm::dvec3& voxel_edge);

/// The light samples of a disk or rectangle: `light.light_samples` equal parts of its area and
/// intensity. A disk's samples lie on Vogel's spiral, a rectangle's in the middles of boxes that
/// divide it evenly.
std::vector<LightRecord> area_light_samples(const Light& light, const GridFrame& world);

/// The area of a disk or rectangle, from all of which it shines.
LightAreaRecord light_area_record(const Light& light, const GridFrame& world);

/// The light samples of all emissive objects, in the order of the objects. Each object's surface in
/// the world is found voxel by voxel and divided into parts that lie together and face the same
/// way.
///
/// A light sample has its part's whole area and emission. It lies a little above a point of the
/// surface, so that a ray that ends there is clear of it (kLightSampleOffset). Surfaces that lie in
/// the world's sides and face outwards have no samples. The result is equal on every device. The
/// kernels are compiled here, so call this only for a scene with emissive objects. Throws
/// Error::limit if the device's memory doesn't suffice.
std::vector<LightRecord> emissive_light_samples(const Device& device, const Features& features,
                                                const Scene& scene, const Pyramid& world);

}  // namespace voxelume
