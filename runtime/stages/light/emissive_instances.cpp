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

/// A piece of a model's surface, which an affine map puts into the world.
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

/// The pieces of an instance's model, in the model's own space. `materials` are those of its
/// groups.
std::vector<EmissivePiece> model_pieces(const Device& device, const Features& features,
                                        const Scene& scene, const Pyramid& world,
                                        const Instance& instance,
                                        std::span<const uint32_t> materials) {
    const InstanceModel& model = world.instances.models[instance.model];
    EmissiveSource source{.pyramid = world,
                          .first_sector = model.first_sector,
                          .first_triangle = model.first_triangle,
                          .triangle_count = model.triangle_count,
                          .is_emissive = {1},
                          .light_samples = {scene.objects[instance.object].light_samples}};
    source.pyramid.frame = model.frame;
    // Packed attributes of models hold numbers of groups; the last material is that of all further
    // ones.
    for (size_t group = 0; group <= VXL_MATERIAL_MASK; ++group)
        source.emission.push_back(
            scene.materials[materials[std::min(group, materials.size() - 1)]].emission);
    return std::move(pieces_of_source(device, features, source)[0]);
}

/// What the pieces of a model depend on, besides the model's voxels.
struct ModelUse {
    uint32_t model = 0;
    std::optional<int> light_samples;
    std::vector<uint32_t> materials;

    friend auto operator<=>(const ModelUse&, const ModelUse&) = default;
};

}  // namespace

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
        const std::span<const uint32_t> own =
            std::span(materials).subspan(instance.first_material, instance.material_count);
        const ModelUse use{instance.model, object.light_samples, {own.begin(), own.end()}};
        auto found = known.find(use);
        if (found == known.end())
            found = known.emplace(use, model_pieces(device, features, scene, world, instance, own))
                        .first;
        std::vector<EmissivePiece>& added = pieces[instance.object];
        for (const EmissivePiece& piece : found->second)
            added.push_back(
                placed(piece, object.world_from_object, model.frame.origin, world.frame.origin));
    }
}

}  // namespace voxelume
