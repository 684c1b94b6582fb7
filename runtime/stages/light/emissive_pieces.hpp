// SPDX-License-Identifier: Apache-2.0
// a world's emissive objects -> the pieces of surface that emit their light.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/light/light_sample_choice.hpp"

namespace voxelume {

/// The area in square metres of the plane through `point` perpendicular to `gradient`, within a
/// voxel whose edges are `edge` metres. `point` and `gradient` are in voxels.
double area_in_voxel(const glm::dvec3& point, const glm::dvec3& gradient, const glm::dvec3& edge);

/// Voxels with surfaces that may emit light: the world's, or those of an instance's model.
struct EmissiveSource {
    Pyramid pyramid;            ///< pyramid in the frame of these voxels
    uint32_t first_sector = 0;  ///< start of their table in the pyramid's sectors; 0: the world's
    uint32_t first_triangle = 0, triangle_count = 0;
    /// Indexed by the objects' numbers in packed attributes, which are 0 in models.
    std::vector<uint32_t> is_emissive{};
    std::vector<std::optional<int>> light_samples{};
    std::vector<glm::vec3> emission{};   ///< indexed by the materials' numbers in packed attributes
    std::optional<uint32_t> instance{};  ///< for a model: the number of an object that shows it
};

/// A piece as kernels list it, see shared/light_samples.h.
using ListedPiece = std::array<uint32_t, 4>;

/// The world's own voxels. `is_emissive` has a value per object; those of instances become 0.
EmissiveSource world_source(const Scene& scene, const Pyramid& world,
                            const std::vector<uint32_t>& is_emissive);

/// A use of a model by instances that differ only in their placements.
struct ModelUse {
    uint32_t model = 0;
    std::optional<int> light_samples;
    std::vector<uint32_t> materials;  ///< of its groups; the last serves all further groups

    friend bool operator<(const ModelUse& a, const ModelUse& b) {
        return std::tie(a.model, a.light_samples, a.materials) <
               std::tie(b.model, b.light_samples, b.materials);
    }
};

/// The use of a model by an instance. `materials` are all of InstanceSet::materials.
ModelUse model_use(const Scene& scene, const Instance& instance,
                   std::span<const uint32_t> materials);

EmissiveSource model_source(const Scene& scene, const Pyramid& world, const ModelUse& use);

/// The voxels with emissive surfaces of any kind, sorted by z, y and x. In each entry, the sides at
/// which rays meet the surfaces replace the piece's form.
std::vector<ListedPiece> emissive_voxels(const Device& device, const Features& features,
                                         const EmissiveSource& source);

/// Pieces by the numbers of their objects.
using PiecesOfObjects = std::map<uint32_t, std::vector<EmissivePiece>>;

/// The pieces of each emissive object: an open face of a cube, the part of a smooth surface or an
/// exact solid in a voxel, a triangle or its parts. A closed mesh emits outwards, an open one to
/// both sides.
///
/// `is_emissive` has a value per object. Pieces of cubes and voxels come first, in the order of
/// their positions, then those of triangles, in the order of the mesh.
PiecesOfObjects emissive_pieces(const Device& device, const Features& features, const Scene& scene,
                                const Pyramid& world, const std::vector<uint32_t>& is_emissive);

/// The pieces of one source. Positions are metres from its frame's first corner.
PiecesOfObjects pieces_of_source(const Device& device, const Features& features,
                                 const EmissiveSource& source);

/// Adds the pieces of emissive instances, in the world. Pieces of a model are found once for all
/// instances that show it with the same materials.
void add_instance_pieces(const Device& device, const Features& features, const Scene& scene,
                         const Pyramid& world, const std::vector<uint32_t>& is_emissive,
                         PiecesOfObjects& pieces);

/// Adds only the triangles of the emissive objects.
void add_emissive_triangles(const EmissiveSource& source, PiecesOfObjects& pieces);

}  // namespace voxelume
