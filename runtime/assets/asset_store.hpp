// SPDX-License-Identifier: Apache-2.0
// files of models -> meshes and voxels in memory. Each file is read once, and only when needed.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "runtime/assets/model_cache.hpp"
#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/geometry/mesh_targets.hpp"
#include "runtime/geometry/shape/mesh_shape.hpp"
#include "runtime/geometry/thin_part.hpp"
#include "runtime/geometry/voxel_model.hpp"
#include "runtime/io/gltf/gltf_file.hpp"
#include "runtime/io/gltf/gltf_skin.hpp"
#include "runtime/io/voxels/vox_file.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The meshes and voxels of a scene. Each file is read once, on first use, and kept while it is
/// used. Answers that `cache` has are given without reading the mesh.
class AssetStore {
  public:
    explicit AssetStore(ModelCache cache = {}) : cache_(std::move(cache)) {}

    /// The mesh of a file, or a part of a glTF file, after a map. Throws Error::input as read_mesh
    /// and gltf_mesh do, and for a file that changed since it was first read.
    const Mesh& mesh(const std::filesystem::path& file, const FileMap& map = {}, int part = 0);
    /// A glTF file, which is kept while its meshes are used. Throws Error::input as GltfFile does.
    const GltfFile& gltf_file(const std::filesystem::path& file);
    /// The voxels of a model that has a file of them. Throws Error::input as read_voxel_model does.
    const VoxelModel& voxels(const Model& model);
    /// The content of a MagicaVoxel file without its voxels. Throws Error::input as read_vox_file
    /// does.
    const VoxFile& vox_file(const std::filesystem::path& file);
    /// The mesh that is voxelized for a model: its own or thin parts of that, or the triangles of a
    /// file of exact voxels. Null for other models.
    const Mesh* mesh_of(const Model& model);
    /// The thin parts of a model's mesh for voxels of its `thin_edge`.
    const ThinPart& thin_part_of(const Model& model);
    /// A summary of the mesh that mesh_of() returns; null where there is none.
    const MeshSummary* summary_of(const Model& model);
    /// The winding number around a point, in object space, of the mesh that mesh_of() returns: how
    /// far it encloses the point. 0 for other models. Reads the mesh unless the cache has the
    /// number.
    double winding_of(const Model& model, const glm::dvec3& point);
    /// The properties of a model's mesh file that decide which surface suits it; a morph doesn't
    /// count.
    MeshShape shape_of(const Model& model);
    /// The thickness part of shape_of(), which takes a sixth of the time.
    MeshThickness thickness_of(const Model& model);
    /// The surface that a model's file of voxels holds, with the reason. An OpenVDB file has cubes,
    /// and without those a level set. Throws as voxels() does.
    SurfaceChoice surface_of_voxels(Model model);
    /// The names of a model's groups of faces or voxels.
    const std::vector<std::string>& groups_of(const Model& model);
    /// The box around the surface in a model's file, in the file's own coordinates. Contents that
    /// aren't to be kept are forgotten if they had to be read for it. Throws Error::input likewise.
    Bounds box_of_file(const Model& model, bool keeps);
    /// A hash of everything that the model's mesh is made from. Empty for a model without a mesh
    /// file, and where nothing is kept on disk.
    std::string source_of(const Model& model);

    /// A hash of the voxels of a model that has a file of them, or of some in memory. Empty for
    /// voxels with triangles, and where nothing is kept on disk. Throws Error::input as voxels()
    /// does. Voxels that are read again after they were forgotten must be the same.
    const std::string& source_of_voxels(const Model& model);

    /// Retains the loaded contents of a model's files past the next call of `forget_unused`.
    /// Contents that were used since its last call are always retained. Unused meshes and voxels
    /// are retained only if they take no more than `room` bytes, which are subtracted from `room`.
    void retain(const Model& model, uint64_t& room);
    /// Forgets everything that wasn't used since the last call.
    void forget_unused();
    /// A copy of this store whose counts of reading start at zero.
    AssetStore recounted() const;

    const ModelCache& cache() const { return cache_; }
    double load_seconds() const { return load_seconds_; }
    uint64_t meshes_read() const { return meshes_read_; }  ///< files of meshes and of voxels
    uint64_t triangles() const;                            ///< sum over the meshes that are in use

  private:
    struct MappedMesh {
        std::optional<Mesh> mesh;
        std::optional<MeshSummary> summary;
    };
    struct ThinPartOfMesh {
        std::optional<ThinPart> part;
        std::optional<MeshSummary> summary;
    };
    /// The numbers of a FileMap, as a key.
    using MapKey = std::array<double, 4>;
    struct MeshFile {
        std::string source;  ///< hash of the file's bytes; empty without a cache
        std::optional<Mesh> mesh;
        std::optional<MeshSummary> summary;
        std::optional<MeshShape> shape;
        std::optional<std::vector<MorphTarget>> targets;
        std::map<std::pair<int, std::string>, std::shared_ptr<const GltfSkin>>
            skins;  ///< by number and clip
        std::map<MapKey, MappedMesh> mapped;
        std::map<std::pair<MapKey, double>, ThinPartOfMesh> thin;  ///< by edges of voxels, too

        void forget_meshes();
    };
    struct Morphed {
        std::filesystem::path file;
        FileMap map;
        Morph morph;
        std::optional<Mesh> mesh;
        std::optional<MeshSummary> summary;
    };
    struct VoxelFile {
        VoxelModel voxels;
        MeshSummary summary;  ///< summary of the voxels' mesh
    };

    /// The file, the surface that it is read as, its map, the part and the values.
    using VoxelKey = std::tuple<std::filesystem::path, Surface, MapKey, int, VoxelValues>;

    static MapKey key_of(const FileMap& map);
    static VoxelKey voxel_key(const Model& model);
    /// A file, and the part of it that is meant; 0: all of it.
    using MeshName = std::pair<std::filesystem::path, int>;

    MeshFile& file(const MeshName& name);
    const std::string& source_of_file(const std::filesystem::path& path);
    std::string bytes_of_file(const std::filesystem::path& path);
    Mesh read(const MeshName& name);
    uint64_t triangles_of(const std::filesystem::path& name, const MeshFile& file) const;
    uint64_t bytes_of(const std::filesystem::path& name) const;
    void forget(const std::filesystem::path& name);
    template <typename Value>
    using CacheGetter = std::optional<Value> (ModelCache::*)(const std::string& source) const;
    template <typename Value, typename Make>
    const Value& known(std::optional<Value>& value, const std::string& source,
                       CacheGetter<Value> cached, const Make& make);
    const MeshSummary& summary_of_file(const MeshName& name, const FileMap& map = {});
    const MeshShape& shape_of_file(const MeshName& name, bool is_whole);
    VoxelModel read_voxels(const Model& model);
    const VoxelFile& voxel_file(const Model& model);
    Morphed& morphed(const Model& model);
    const Mesh& morphed_mesh(const Model& model);
    const MeshSummary& morphed_summary(const Model& model);
    /// The targets of a morph by weights, which has at most as many weights.
    const std::vector<MorphTarget>& targets_of(const Model& model);
    /// The skin of a morph that has one.
    const GltfSkin& skin_of(const Model& model);
    ThinPartOfMesh& thin_part(const Model& model);
    const MeshSummary& thin_summary(const Model& model);
    Mesh mesh_moved_by_file(const Model& model);
    Bounds box_moved_by_file(const Model& model, const Bounds& box);

    ModelCache cache_;
    std::map<MeshName, MeshFile> files_;
    std::map<std::filesystem::path, std::string> sources_;  ///< hashes of whole files
    std::map<std::filesystem::path, std::shared_ptr<const GltfFile>> gltf_files_;
    std::map<std::string, Morphed> morphed_;  ///< by the model's name, as last used
    std::map<VoxelKey, VoxelFile> voxels_;
    std::map<VoxelKey, std::string> voxel_sources_;  ///< hashes of their contents
    std::map<std::filesystem::path, VoxFile> vox_files_;
    std::set<std::filesystem::path> used_;
    std::set<std::string> used_morphs_;  ///< names of models
    double load_seconds_ = 0;
    uint64_t meshes_read_ = 0;
};

}  // namespace voxelume
