#include "runtime/instances.hpp"

#include <chrono>
#include <map>

#include "runtime/error.hpp"
#include "runtime/model_grid.hpp"
#include "runtime/stages/index.hpp"
#include "runtime/stages/instance_pools.hpp"
#include "runtime/stages/instances.hpp"
#include "runtime/stages/spots.hpp"

namespace voxelume {
namespace {

/// Why an object can't be an instance; empty if it can.
std::string refusal(const Scene& scene, const Object& object) {
    if (is_lamp(scene, object))
        return "its emission lights the world, and lamps are found in the world's voxels";
    if (transmits(scene, object))
        return "a material of it lets light through, and rays go through objects in the world's "
               "voxels only";
    if (scene.observer.display.layout == VolumeLayout::lattice)
        return "the display's layout is \"lattice\", which shows the world's voxels";
    return "";
}

/// The models of instances, each once.
class ModelPool {
  public:
    ModelPool(const Device& device, MeshStore& meshes)
        : device_(device), voxelizer_(device, meshes) {}

    uint32_t number_of(const Model& model) {
        const auto [entry, added] = numbers_.emplace(&model, uint32_t(pyramids_.size()));
        if (added) {
            pyramids_.push_back(build_index(device_, voxelizer_.in_own_frame(model)));
            if (pyramids_.back().transparent)
                throw Error(ErrorKind::scene,
                            "{}: some of its voxels let light through, and rays go through objects "
                            "in the world's voxels only: give its objects \"placement\": \"world\"",
                            model.where);
        }
        return entry->second;
    }

    const std::vector<Pyramid>& pyramids() const { return pyramids_; }

  private:
    const Device& device_;
    ModelVoxelizer voxelizer_;
    std::map<const Model*, uint32_t> numbers_;
    std::vector<Pyramid> pyramids_;
};

}  // namespace

bool is_instanced(const Scene& scene, const Object& object) {
    if (object.placement == Placement::automatic)
        return object.moves && refusal(scene, object).empty();
    return object.placement == Placement::instance;
}

void check_placements(const Scene& scene) {
    for (const Object& object : scene.objects) {
        if (object.placement != Placement::instance) continue;
        const std::string reason = refusal(scene, object);
        if (!reason.empty())
            throw Error(ErrorKind::scene,
                        "{}: the object \"{}\" can't be placed as an instance: {}; give it "
                        "\"placement\": \"world\"",
                        object.where, object.name, reason);
    }
}

Pyramid add_instances(const Device& device, const Scene& scene, MeshStore& meshes, Pyramid world,
                      InstanceReport& report) {
    const auto start = std::chrono::steady_clock::now();
    ModelPool models(device, meshes);
    std::vector<Instance> list;
    std::vector<uint32_t> materials;
    for (uint32_t number = 0; number < scene.objects.size(); ++number) {
        const Object& object = scene.objects[number];
        if (!is_instanced(scene, object) || !is_in_reach(scene, object)) continue;
        const Model& model = scene.models[size_t(object.model)];
        const std::vector<int> groups = materials_of_groups(object, meshes.groups_of(model));
        list.push_back({.object = number,
                        .model = models.number_of(model),
                        .first_material = uint32_t(materials.size()),
                        .material_count = uint32_t(groups.size())});
        for (const int material : groups) materials.push_back(uint32_t(material));
    }
    if (list.empty()) return world;
    Pyramid joined = join_models(device, world, models.pyramids());
    set_instances(device, list, materials, joined);
    move_instances(scene, joined);
    device.finish();
    report.instances = uint32_t(joined.instances.list.size());
    report.models = uint32_t(models.pyramids().size());
    for (const Pyramid& model : models.pyramids()) report.voxels += model.voxel_count;
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return joined;
}

void move_instances(const Scene& scene, Pyramid& world) {
    std::vector<glm::dmat4> maps;
    maps.reserve(scene.objects.size());
    for (const Object& object : scene.objects) maps.push_back(object.world_from_object);
    place_instances(maps, world);
}

}  // namespace voxelume
