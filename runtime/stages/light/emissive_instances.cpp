// SPDX-License-Identifier: Apache-2.0
// instances of emissive objects -> pieces of surface: those of their models, placed in the world.
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <optional>
#include <span>

#include "kernels/shared/voxel.h"
#include "runtime/stages/light/emissive_pieces.hpp"

namespace voxelume {
namespace {

/// A piece of a model's surface, transformed into the world by an affine map.
EmissivePiece placed(EmissivePiece piece, const glm::dmat4& world_from_object,
                     const glm::dvec3& model_origin, const glm::dvec3& world_origin) {
    const glm::dmat3 linear(world_from_object);
    const glm::dvec3 normal = glm::transpose(glm::inverse(linear)) * piece.normal;
    const double length = glm::length(normal);
    piece.position =
        glm::dvec3(world_from_object * glm::dvec4(model_origin + piece.position, 1)) - world_origin;
    piece.normal = normal / length;
    piece.area *= std::abs(glm::determinant(linear)) * length;
    return piece;
}

}  // namespace

ModelUse model_use(const Scene& scene, const Instance& instance,
                   std::span<const uint32_t> materials) {
    const auto own = materials.subspan(instance.first_material, instance.material_count);
    return {instance.model, scene.objects[instance.object].light_samples, {own.begin(), own.end()}};
}

EmissiveSource model_source(const Scene& scene, const Pyramid& world, const ModelUse& use) {
    const InstanceModel& model = world.instances.models[use.model];
    EmissiveSource source{.pyramid = world,
                          .first_sector = model.first_sector,
                          .first_triangle = model.first_triangle,
                          .triangle_count = model.triangle_count,
                          .is_emissive = {1},
                          .light_samples = {use.light_samples}};
    source.pyramid.frame = model.frame;
    for (const Instance& instance : world.instances.list)
        if (instance.model == use.model) source.instance = instance.object;
    // In models, packed attributes hold numbers of groups.
    for (size_t group = 0; group <= VXL_MATERIAL_MASK; ++group)
        source.emission.push_back(
            scene.materials[use.materials[std::min(group, use.materials.size() - 1)]].emission);
    return source;
}

void add_instance_pieces(const Device& device, const Features& features, const Scene& scene,
                         const Pyramid& world, const std::vector<uint32_t>& is_emissive,
                         PiecesOfObjects& pieces) {
    const InstanceSet& instances = world.instances;
    if (instances.empty()) return;
    const std::vector<uint32_t> materials = instances.materials.read();
    std::map<ModelUse, std::vector<EmissivePiece>> known;
    for (const Instance& instance : instances.list) {
        if (is_emissive[instance.object] == 0) continue;
        const Object& object = scene.objects[instance.object];
        const InstanceModel& model = instances.models[instance.model];
        const ModelUse use = model_use(scene, instance, materials);
        auto found = known.find(use);
        if (found == known.end()) {
            const EmissiveSource source = model_source(scene, world, use);
            found = known.emplace(use, pieces_of_source(device, features, source)[0]).first;
        }
        std::vector<EmissivePiece>& added = pieces[instance.object];
        for (const EmissivePiece& piece : found->second)
            added.push_back(
                placed(piece, object.world_from_object, model.frame.origin, world.frame.origin));
    }
}

}  // namespace voxelume
