// SPDX-License-Identifier: Apache-2.0
// scene and world -> the features its kernels are compiled for, and the memory its rays take
#pragma once

#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/trace/ray_arrays.hpp"

namespace voxelume {

/// The features that the scene and its world really contain, as far as the image's channels need
/// them. Objects outside of the world contribute none.
Features features_of(const Scene& scene, const Pyramid& world);

/// Adds what the scene decides to the features of a world's voxels. From the world it reads where
/// objects are, but no voxels.
void add_scene(const Scene& scene, const Pyramid& world, Features& features);

/// True if surfaces in local light look to the sky in some directions.
bool has_sky_samples(const Scene& scene);

/// True if some object that the world may show is an emissive object.
bool has_emissive_object(const Scene& scene, const Pyramid& world);

/// True if light along rays is asked for, a light shines (or in local light an emissive object),
/// and something that the world may show isn't black.
bool has_light(const Features& features, const Scene& scene, const Pyramid& world);

/// The maximum number of reflections and refractions in a row of local light. It is 0 where no
/// surface that may be shown sends rays on in a new direction.
size_t max_depth(const Features& features, const Scene& scene, const Pyramid& world);

/// The rays of the scene's flat image that go together.
RayCounts ray_counts(const Device& device, const Scene& scene, const Features& features);

}  // namespace voxelume
