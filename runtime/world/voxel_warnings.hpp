// SPDX-License-Identifier: Apache-2.0
// built world -> warnings for objects without voxels, and for a world that the cache doesn't store
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/assets/model_cache.hpp"
#include "runtime/base/warning.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/place/place.hpp"

namespace voxelume {

/// Adds a warning for each of the `placed` objects whose grid stores no brick.
void add_empty_objects(const Scene& scene, std::span<const PlacedObject> placed,
                       std::vector<Warning>& warnings);

/// Adds a warning for every one of the `placed` objects, if their world has no voxels at all. The
/// objects' grids may be gone.
void add_all_objects(const Scene& scene, std::span<const PlacedObject> placed,
                     std::vector<Warning>& warnings);

/// Adds a warning for each instance of a model without voxels.
void add_empty_instances(const Scene& scene, const InstanceSet& instances,
                         std::vector<Warning>& warnings);

/// Adds a warning for a world that took `seconds` and is too large for the cache.
void add_large_world(const World& world, uint64_t bytes, double seconds, const ModelCache& cache,
                     std::vector<Warning>& warnings);

}  // namespace voxelume
