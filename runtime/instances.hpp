// scene -> instances: the objects that keep voxels of their own, behind the world's pyramid.
#pragma once

#include "runtime/grid.hpp"
#include "runtime/model_frame.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene.hpp"

namespace voxelume {

/// Whether rays are carried into the object's space, instead of the object into the world's.
///
/// `auto` is `world` for an object that stands still, and for one that can't be an instance: a lamp
/// (its spots are found in the world's voxels), one that lets light through, one in a scene whose
/// display is a lattice (which shows the world's voxels).
bool is_instanced(const Scene& scene, const Object& object);

/// Throws Error::scene, saying why, for an object that is to be an `instance` and can't.
void check_placements(const Scene& scene);

/// What instances take, for people and tests.
struct InstanceReport {
    uint32_t instances = 0, models = 0;
    uint64_t voxels = 0;  ///< of the models, each counted once
    double seconds = 0;   ///< voxelizing, indexing and joining models, placing instances
};

/// The world with the scene's instances, each model voxelized once in its own frame. Without any
/// the world stays as it is. Throws as form_world does.
Pyramid add_instances(const Device& device, const Scene& scene, MeshStore& meshes, Pyramid world,
                      InstanceReport& report);

/// Moves a world's instances to where the scene's objects are now.
void move_instances(const Scene& scene, Pyramid& world);

}  // namespace voxelume
