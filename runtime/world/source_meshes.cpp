// SPDX-License-Identifier: Apache-2.0
#include "runtime/world/source_meshes.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "runtime/analysis/cube_steps.hpp"
#include "runtime/analysis/object_lattice.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

/// The maximum distance, in voxels, of a surface from its mesh. Surfaces farther away, such as cuts
/// or caps over holes, show the colours of voxels.
constexpr double kReach = 2;

/// The map from a lattice's voxels to the space that it lies in.
glm::dmat4 space_from_voxels(const GridFrame& frame) {
    glm::dmat4 map(1);
    for (int axis = 0; axis < 3; ++axis) map[axis][axis] = frame.voxel_edge[axis];
    map[3] = glm::dvec4(frame.origin, 1);
    return map;
}

SourceRecord record_of(const SourceOffsets& offsets, const glm::dmat4& mesh_from_voxels,
                       double longest_edge) {
    SourceRecord record{};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            record.mesh_from_voxels[4 * row + column] = float(mesh_from_voxels[column][row]);
    record.nodes = offsets.nodes;
    record.triangles = offsets.triangles;
    record.worn = offsets.worn;
    record.textures = offsets.textures;
    for (int axis = 0; axis < 3; ++axis)
        longest_edge = std::max(longest_edge, glm::length(glm::dvec3(mesh_from_voxels[axis])));
    record.reach = float(kReach * longest_edge);
    return record;
}

/// The longest edge of the voxels from which an object was made; 0 on the world's own lattice.
double own_edge(ObjectLattices& lattices, const Object& object) {
    if (lattices.lattice_of(object) == Lattice::world) return 0;
    const glm::dvec3 edge = lattices.own_frame(object).voxel_edge;
    return std::max({edge.x, edge.y, edge.z});
}

/// The records of all objects, those without a mesh included.
std::vector<SourceRecord> records_of(const Scene& scene, AssetStore& meshes,
                                     const ListedSources& sources, const ListedInstances& listed,
                                     const std::vector<SourceOffsets>& offsets) {
    std::vector<SourceRecord> records(scene.objects.size(), record_of({}, glm::dmat4(1), 0));
    ObjectLattices lattices(scene, meshes);
    const glm::dmat4 world = space_from_voxels(world_frame(scene.world));
    for (const SourceObject& source : sources.objects) {
        const auto instance = std::ranges::find(listed.list, source.object, &Instance::object);
        SourceRecord& record = records[source.object];
        const SourceOffsets& model_offsets = offsets[source.model];
        if (instance != listed.list.end()) {
            record = record_of(model_offsets,
                               space_from_voxels(listed.grids[instance->model]->frame), 0);
            continue;
        }
        const Object& object = scene.objects[source.object];
        record = record_of(model_offsets, glm::inverse(object.world_from_object) * world,
                           own_edge(lattices, object));
    }
    return records;
}

}  // namespace

SourceMeshes SourceMeshCache::meshes_of(const Scene& scene, AssetStore& meshes,
                                        const ListedInstances& listed) {
    const ListedSources sources = list_sources(scene, meshes);
    if (sources.objects.empty()) {
        forget();
        return {};
    }
    std::vector<Model> models;
    models.reserve(sources.models.size());
    for (const int model : sources.models) {
        models.push_back(scene.models[size_t(model)]);
        models.back().extent = {};  // the extent changes with the placements of objects
    }
    if (models != models_) {
        forget();
        std::vector<const Mesh*> read;
        read.reserve(models.size());
        for (const Model& model : models) read.push_back(meshes.mesh_of(model));
        joined_ = join_source_meshes(device_, read);
        models_ = std::move(models);
    }
    const std::vector<SourceRecord> records =
        records_of(scene, meshes, sources, listed, joined_.offsets);
    return {joined_.words,
            Buffer<SourceRecord>(device_, "source objects", std::span<const SourceRecord>(records)),
            joined_.has_maps};
}

Buffer<float> cube_steps_on(const Device& device, const Scene& scene, AssetStore& meshes,
                            std::span<const VoxelBox> boxes) {
    const std::vector<float> steps = cube_steps(scene, meshes, boxes);
    if (steps.empty()) return {};
    return Buffer<float>(device, "cube steps", std::span<const float>(steps));
}

Buffer<uint32_t> coincidence_order_on(const Device& device, const Scene& scene) {
    const std::vector<uint32_t> order = coincidence_order(scene);
    if (order.empty()) return {};
    return Buffer<uint32_t>(device, "order of objects", std::span<const uint32_t>(order));
}

}  // namespace voxelume
