// SPDX-License-Identifier: Apache-2.0
// scene -> instances: the objects that keep voxels of their own, behind the world's pyramid.
#pragma once

#include "runtime/analysis/placed_objects.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/instance/instance_model.hpp"

namespace voxelume {

/// The work and memory of instances, for people and tests.
struct InstanceReport {
    uint32_t instances = 0, models = 0;
    uint32_t moved = 0;  ///< instances that have another place than in the frame before, or are new
    uint32_t indexed = 0;            ///< models whose pyramid was built for this frame
    uint64_t voxels = 0, bytes = 0;  ///< voxels and bytes of the models, each counted once
    double seconds = 0;              ///< indexing and joining models, placing instances
};

/// Puts instances behind worlds, and keeps the pyramids of their models.
class InstanceModels {
  public:
    explicit InstanceModels(const Device& device) : device_(device) {}

    /// Forgets the pyramids of models that aren't `listed`, except those whose grids are retained
    /// elsewhere: of these it keeps the ones made first, up to `room` bytes of the device.
    void forget_unused(const ListedInstances& listed, uint64_t room);

    /// The world with the scene's instances; without instances the world is unchanged. Throws
    /// Error::limit if memory doesn't suffice.
    Pyramid join(const Scene& scene, const ListedInstances& listed, Pyramid world,
                 InstanceReport& report);

  private:
    struct Kept {
        SharedGrid grid;
        ModelPyramid model;
    };

    Device device_;
    std::vector<Kept> kept_;
};

/// The placement of an object that is an instance.
struct InstancePlace {
    uint32_t object = 0;  ///< its number in the scene
    glm::dmat4 world_from_object{1};
    friend bool operator==(const InstancePlace&, const InstancePlace&) = default;
};

/// The placements of a world's instances, ascending by object.
std::vector<InstancePlace> instance_places(const Scene& scene, const Pyramid& world);

/// The number of placements in `now` that aren't in `before`.
uint32_t count_moved(const std::vector<InstancePlace>& before,
                     const std::vector<InstancePlace>& now);

/// Removes the values that change if only instances move from copies of a scene's models and
/// objects.
void leave_out_places_of_instances(const Scene& scene, std::vector<Model>& models,
                                   std::vector<Object>& objects);

/// Moves a world's instances to the current placements of the scene's objects.
void move_instances(const Device& device, const Scene& scene, Pyramid& world);

}  // namespace voxelume
