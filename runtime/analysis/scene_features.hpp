// scene and world -> what its kernels are compiled for, and what its rays take.
#pragma once

#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/trace/ray_arrays.hpp"

namespace voxelume {

/// What the scene and its world really contain, of objects that lie outside of the world nothing;
/// and of that what the image's channels need.
Features features_of(const Scene& scene, const Pyramid& world);

/// Adds to the features of a world's voxels what the scene decides; of the world it asks where
/// objects are, and no voxels.
void add_scene(const Scene& scene, const Pyramid& world, Features& features);

/// Whether any light comes from it.
bool shines(const Light& light);

/// Whether it shines from a patch, not from one point or direction.
bool has_area(const Light& light);

/// The lights that a scene lists, those with an area by their samples.
std::vector<LightRecord> given_lights(const Scene& scene, const GridFrame& world);

/// Whether some object that the world may show is an emissive object.
bool has_emissive_object(const Scene& scene, const Pyramid& world);

/// Whether colour is asked for, a light or an emissive object shines, and something that the world
/// may show isn't black.
bool has_light(const Scene& scene, const Pyramid& world);

/// Reflections and refractions in a row: none where no surface that may be shown sends rays on,
/// other than straight through.
size_t max_depth(const Features& features, const Scene& scene, const Pyramid& world);

/// The rays of the scene's flat image that go together.
RayCounts ray_counts(const Scene& scene, const Features& features);

}  // namespace voxelume
