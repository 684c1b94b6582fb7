// The lattices that a scene asks for: of the world, and of each model in its own space.
#pragma once

#include <map>
#include <set>

#include "runtime/grid.hpp"
#include "runtime/mesh.hpp"
#include "runtime/scene.hpp"
#include "runtime/voxel_model.hpp"

namespace voxelume {

/// Margin of empty voxels around a model, so that the differences of a smooth surface lie inside.
inline constexpr int kModelMargin = 4;

/// The meshes and voxels of a scene, each file read once, when it is first asked for, and
/// kept while it is used.
class MeshStore {
  public:
    /// Throws Error::input as read_mesh does.
    const Mesh& mesh(const std::filesystem::path& file);
    /// The voxels of a model that has a file of them. Throws Error::input as read_voxel_model does.
    const VoxelModel& voxels(const Model& model);
    /// What is voxelized for a model: its mesh, or the triangles of a file of exact voxels; null
    /// for the others.
    const Mesh* mesh_of(const Model& model);
    /// The names of a model's groups of faces or voxels.
    const std::vector<std::string>& groups_of(const Model& model);

    /// Forgets what wasn't asked for since the last call.
    void forget_unused();

    double load_seconds() const { return load_seconds_; }
    uint64_t triangles() const;  ///< of the meshes that are there

  private:
    struct Morphed {
        std::filesystem::path file;
        Morph morph;
        Mesh mesh;
    };
    const Mesh& morphed(const Model& model);

    std::map<std::filesystem::path, Mesh> meshes_;
    std::map<std::string, Morphed> morphed_;  ///< by the model's name, as last asked for
    std::map<std::filesystem::path, VoxelModel> voxels_;
    std::set<std::filesystem::path> used_;
    double load_seconds_ = 0;
};

/// The world's lattice: its first voxel starts at the bounds' minimum corner.
GridFrame world_frame(const World& world);

/// The box around the triangles of a mesh.
Bounds mesh_bounds(const Mesh& mesh);

/// The lattice of a model in its own space, with kModelMargin. `mesh` is null for a solid.
///
/// Throws Error::input for a model without extent whose voxels `resolution` decides, Error::limit
/// for more voxels than can be numbered; the sentence begins with the model's place.
GridFrame model_frame(const Model& model, const Mesh* mesh);

/// Whether rays see the voxels inside of the object, too: solid cubes that let light through.
bool shows_inside(const Scene& scene, const Object& object);

/// Whether any part of the object can be seen inside the world; models that aren't are not read.
bool is_in_reach(const Scene& scene, const Object& object);

}  // namespace voxelume
