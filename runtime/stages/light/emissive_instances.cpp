// SPDX-License-Identifier: Apache-2.0
// instances of emissive objects -> pieces of surface: those of their models, placed in the world.
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

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

}  // namespace

std::vector<EmissivePiece> instance_pieces(const Device& device, const Features& features,
                                           const Scene& scene, const Pyramid& world,
                                           const Instance& instance) {
    const InstanceModel& model = world.instances.models[instance.model];
    const Object& object = scene.objects[instance.object];
    EmissiveSource source{.pyramid = world,
                          .first_sector = model.first_sector,
                          .first_triangle = model.first_triangle,
                          .triangle_count = model.triangle_count,
                          .is_emissive = {1},
                          .light_samples = {object.light_samples}};
    source.pyramid.frame = model.frame;
    // Packed attributes of models hold numbers of groups; the last material is that of all further
    // ones.
    const std::vector<uint32_t> materials =
        world.instances.materials.read(instance.first_material, instance.material_count);
    for (size_t group = 0; group <= VXL_MATERIAL_MASK; ++group)
        source.emission.push_back(
            scene.materials[materials[std::min(group, materials.size() - 1)]].emission);
    PiecesOfObjects found = pieces_of_source(device, features, source);
    std::vector<EmissivePiece> pieces = std::move(found[0]);
    for (EmissivePiece& piece : pieces)
        piece = placed(piece, object.world_from_object, model.frame.origin, world.frame.origin);
    return pieces;
}

}  // namespace voxelume
