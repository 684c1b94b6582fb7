// SPDX-License-Identifier: Apache-2.0
// scene -> the data of each object that rays look up: the meshes whose textures smooth objects
// show, and the steps of cubes with normals.
#pragma once

#include <span>
#include <vector>

#include "runtime/analysis/placed_objects.hpp"
#include "runtime/analysis/source_objects.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/lookup/source_mesh.hpp"

namespace voxelume {

/// Uploads source meshes to a device, and keeps those of the frame before.
class SourceMeshCache {
  public:
    explicit SourceMeshCache(const Device& device) : device_(device) {}

    /// The meshes of a scene whose instances are `listed`. Throws Error::limit if memory doesn't
    /// suffice for the textures.
    SourceMeshes meshes_of(const Scene& scene, AssetStore& meshes, const ListedInstances& listed);

    void forget() { models_.clear(), joined_ = {}; }

  private:
    Device device_;
    std::vector<Model> models_;  ///< models of the frame before
    JoinedSources joined_;
};

/// Pyramid::cube_steps of a scene whose objects have these `boxes`.
Buffer<float> cube_steps_on(const Device& device, const Scene& scene, AssetStore& meshes,
                            std::span<const VoxelBox> boxes);

/// Pyramid::order of a scene.
Buffer<uint32_t> coincidence_order_on(const Device& device, const Scene& scene);

}  // namespace voxelume
