// SPDX-License-Identifier: Apache-2.0
// scene -> the lattice on which each object is voxelized that is placed in the world's voxels.
//
// A field that is resampled at points farther apart than its own is undersampled, and its band may
// end inside a voxel of the world. So a field never has smaller voxels than the world that it is
// resampled into: it is made on the world's own lattice, or on a copy of it in object space.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The space of the voxels that an object is placed with.
enum class Lattice : uint8_t {
    model,   ///< in object space, as the model says: cubes, files, and fields that are coarser than
             ///< the world's or lie on its nodes
    shared,  ///< in object space, about as large as the world's voxels are there: for many copies
    world    ///< in the world, through the object's whole map, so that nothing is resampled
};

/// An object's voxels as they are made and placed.
struct ObjectLattice {
    Lattice lattice = Lattice::model;
    GridFrame frame;
    glm::dmat4 frame_from_object{1};  ///< for making them
    glm::dmat4 world_from_frame{1};   ///< for placing them
};

/// The world's own lattice, as `exact` objects are placed with it.
ObjectLattice world_lattice(const Scene& scene, const Object& object);

/// A scene's choices of lattices. They don't depend on what is visible, so frames agree.
class ObjectLattices {
  public:
    ObjectLattices(const Scene& scene, AssetStore& meshes);

    /// Throws as AssetStore does.
    Lattice lattice_of(const Object& object);

    /// The voxels of an object as they are made and placed. `box` is the object's box from
    /// object_boxes() and isn't empty. Throws as model_frame() does, and Error::scene for a file
    /// with a field that is finer than the world.
    ObjectLattice of(const Object& object, const VoxelBox& box);

    /// The frame of an object's voxels in object space; it isn't on the world's own lattice.
    GridFrame own_frame(const Object& object);

  private:
    Model shared_model(const Object& object) const;
    void check_field(const Object& object);

    const Scene& scene_;
    AssetStore& meshes_;
    std::vector<uint32_t> copies_;  ///< number of each model's objects in the world
};

/// True for an object whose file has a field too fine to be resampled into the world.
bool is_finer_field(const Scene& scene, const Object& object, AssetStore& meshes);

}  // namespace voxelume
