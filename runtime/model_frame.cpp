#include "runtime/model_frame.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>

#include "runtime/error.hpp"
#include "runtime/io/mesh_reader.hpp"
#include "runtime/mesh_morph.hpp"
#include "runtime/stages/solid_bounds.hpp"
#include "runtime/stages/voxelize.hpp"

namespace voxelume {
namespace {

/// The voxel edges of a model whose bounds are `extent`, metres.
glm::dvec3 voxel_edge(const Model& model, const glm::dvec3& extent) {
    if (model.resolution == 0) return model.voxel_size;
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0))
        throw Error(ErrorKind::input,
                    "the model is a single point, so no resolution gives it a "
                    "voxel size: give the voxel size instead");
    return glm::dvec3(longest / model.resolution);
}

GridFrame solid_frame(const Model& model) {
    const SolidBounds reach = {model.reach.min, model.reach.max};
    const glm::dmat4 identity(1);
    const SolidBounds box = bounds(*model.solid, identity, reach);
    const glm::dvec3 edge = voxel_edge(model, box.max - box.min);
    return frame_around(*model.solid, identity, edge, kModelMargin, reach);
}

GridFrame mesh_frame(const Model& model, const Mesh& mesh) {
    const Bounds box = mesh_bounds(mesh);
    return frame_around(mesh, voxel_edge(model, box.max - box.min), kModelMargin);
}

}  // namespace

const Mesh& MeshStore::mesh(const std::filesystem::path& file) {
    used_.insert(file);
    const auto found = meshes_.find(file);
    if (found != meshes_.end()) return found->second;
    const auto start = std::chrono::steady_clock::now();
    const Mesh& mesh = meshes_.emplace(file, read_mesh(file)).first->second;
    load_seconds_ +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return mesh;
}

const VoxelModel& MeshStore::voxels(const Model& model) {
    used_.insert(model.voxels);
    const auto found = voxels_.find(model.voxels);
    if (found != voxels_.end() && found->second.surface == model.surface) return found->second;
    const auto start = std::chrono::steady_clock::now();
    VoxelModel read = read_voxel_model(model.voxels, model.surface);
    load_seconds_ +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return voxels_.insert_or_assign(model.voxels, std::move(read)).first->second;
}

const Mesh* MeshStore::mesh_of(const Model& model) {
    if (model.solid) return nullptr;
    if (model.voxels.empty()) return model.morph ? &morphed(model) : &mesh(model.mesh);
    return model.surface == Surface::exact ? &voxels(model).mesh : nullptr;
}

const Mesh& MeshStore::morphed(const Model& model) {
    const Morph& morph = *model.morph;
    const Mesh& from = mesh(model.mesh);
    const auto found = morphed_.find(model.name);
    if (found != morphed_.end() && found->second.file == model.mesh && found->second.morph == morph)
        return found->second.mesh;
    Mesh mesh_now = morph.mesh.empty()
                        ? morphed_to_sphere(from, morph.center, morph.radius, morph.amount)
                        : ::voxelume::morphed(from, mesh(morph.mesh), morph.amount, model.where);
    return morphed_.insert_or_assign(model.name, Morphed{model.mesh, morph, std::move(mesh_now)})
        .first->second.mesh;
}

const std::vector<std::string>& MeshStore::groups_of(const Model& model) {
    static const std::vector<std::string> none;
    if (model.solid) return none;
    return model.voxels.empty() ? mesh(model.mesh).group_names : voxels(model).groups;
}

void MeshStore::forget_unused() {
    const auto is_unused = [&](const auto& entry) { return !used_.contains(entry.first); };
    std::erase_if(meshes_, is_unused);
    std::erase_if(voxels_, is_unused);
    used_.clear();
}

uint64_t MeshStore::triangles() const {
    uint64_t sum = 0;
    for (const auto& [file, mesh] : meshes_) sum += mesh.triangles.size();
    for (const auto& [file, voxels] : voxels_) sum += voxels.mesh.triangles.size();
    return sum;
}

GridFrame world_frame(const World& world) {
    return {world.bounds.min, world.voxel_size, world.voxels};
}

Bounds mesh_bounds(const Mesh& mesh) {
    Bounds box{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            box.min = glm::min(box.min, glm::dvec3(mesh.positions[triangle[corner]]));
            box.max = glm::max(box.max, glm::dvec3(mesh.positions[triangle[corner]]));
        }
    }
    return box;
}

GridFrame model_frame(const Model& model, const Mesh* mesh) {
    try {
        return mesh ? mesh_frame(model, *mesh) : solid_frame(model);
    } catch (const Error& error) {
        throw Error(error.kind(), "{}: {}", model.where, error.what());
    }
}

bool is_in_reach(const Scene& scene, const Object& object) {
    const Model& model = scene.models[size_t(object.model)];
    const SolidBounds reach = {model.reach.min, model.reach.max};
    if (!object.visible || reach.is_empty()) return false;
    return !model.solid || !bounds(*model.solid, glm::dmat4(1), reach).is_empty();
}

bool shows_inside(const Scene& scene, const Object& object) {
    const Model& model = scene.models[size_t(object.model)];
    return model.surface == Surface::cubes && model.set == VoxelSet::solid &&
           transmits(scene, object);
}

}  // namespace voxelume
