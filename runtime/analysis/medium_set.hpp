// What the rays of a scene may be inside of.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// Members of a ray's set of objects beside the smooth body, at most.
inline constexpr int kMaxMedia = 15;

/// The features that the places of transmitting objects and of the observer decide.
void add_medium_set(const Scene& scene, const Pyramid& world, Features& features);

/// Whether an observer's rays may begin inside of a transmitting object. If none does, the first
/// surfaces that they meet are the same as if nothing transmitted light.
bool may_begin_inside(const Scene& scene, const Pyramid& world);

/// Features of a scene whose rays may begin anywhere in the world, as those for single voxels do.
Features begun_anywhere(Features features, const Scene& scene);

/// Objects that transmit light of which no formula tells whether a ray begins inside: smooth ones
/// and exact meshes.
struct HollowObjects {
    std::vector<uint32_t> flags;  ///< per object: 1 or 0
    uint32_t maximum = 0;         ///< that a ray may be in at once: the smooth ones count as one
};
HollowObjects hollow_objects(const Scene& scene);

}  // namespace voxelume
