// scene -> instances: the objects that keep voxels of their own, behind the world's pyramid.
#pragma once

#include "runtime/analysis/placed_objects.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/instance/instance_model.hpp"

namespace voxelume {

/// What instances take, for people and tests.
struct InstanceReport {
    uint32_t instances = 0, models = 0;
    uint32_t moved = 0;    ///< instances that stand elsewhere than in the frame before, or are new
    uint32_t indexed = 0;  ///< models whose pyramid was built for this frame
    uint64_t voxels = 0, bytes = 0;  ///< of the models, each counted once
    double seconds = 0;              ///< indexing and joining models, placing instances
};

/// Puts instances behind worlds, and keeps the pyramids of their models.
class InstanceModels {
  public:
    explicit InstanceModels(const Device& device) : device_(device) {}

    /// Forgets the pyramids of models that aren't `listed`, but those whose grids others keep; of
    /// these it keeps the first made that take no more than `room` bytes of the device.
    void forget_unused(const ListedInstances& listed, uint64_t room);

    /// The world with the scene's instances. Without any it stays as it is. Throws Error::limit for
    /// too little memory.
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

/// Where an object stands that is an instance.
struct InstancePlace {
    uint32_t object = 0;  ///< its number in the scene
    glm::dmat4 world_from_object{1};
    friend bool operator==(const InstancePlace&, const InstancePlace&) = default;
};

/// The places of a world's instances, ascending by object.
std::vector<InstancePlace> instance_places(const Scene& scene, const Pyramid& world);

/// How many of the places `now` weren't there `before`.
uint32_t count_moved(const std::vector<InstancePlace>& before,
                     const std::vector<InstancePlace>& now);

/// Forgets, in a copy of a scene's models and objects, what changes when instances move alone.
void leave_out_places_of_instances(const Scene& scene, std::vector<Model>& models,
                                   std::vector<Object>& objects);

/// Moves a world's instances to where the scene's objects are now.
void move_instances(const Device& device, const Scene& scene, Pyramid& world);

}  // namespace voxelume
