// What models' meshes, and the worlds of them, were made into, kept on disk between runs under a
// hash of all it comes from.
#pragma once

#include <glm/mat4x4.hpp>

#include <optional>
#include <string>

#include "runtime/base/disk_cache.hpp"
#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/stages/voxelize/voxelize_options.hpp"

namespace voxelume {

/// Names the bytes of a mesh file, and with them the mesh that they are read as. The file's name
/// counts by its extension only.
std::string mesh_source(const std::string& bytes, const std::filesystem::path& name);

/// Names a mesh on its way from one source to another; `to` is empty for a sphere.
std::string morph_source(const std::string& from, const std::string& to, const Morph& morph);

/// Names the voxels of the mesh that `source` names. The same for all devices, whose bits agree.
std::string grid_key(const std::string& source, const VoxelizeOptions& options,
                     const glm::dmat4& frame_from_mesh, const GridFrame& frame);

/// Names the voxels of a world that the sources named by `parts` make up.
std::string world_key(std::string_view parts);

/// Summaries and voxels of meshes on disk, and worlds, shared by any number of processes.
///
/// Entries are those of DiskCache: whole or absent, and absent once damaged. They are named by
/// what they are made of and by the code that makes them, so that none is ever out of date. What is
/// made as quickly as it would be read isn't kept.
class ModelCache {
  public:
    /// Keeps nothing.
    ModelCache() = default;
    /// Keeps up to `max_bytes` of what takes `min_seconds` or more to make.
    ModelCache(std::filesystem::path folder, uint64_t max_bytes, double min_seconds = 0.001)
        : is_open_(!folder.empty() && max_bytes > 0),
          store_(std::move(folder), max_bytes),
          max_bytes_(max_bytes),
          min_seconds_(min_seconds) {}

    /// The same, which keeps worlds, too.
    ModelCache with_worlds() const {
        ModelCache cache = *this;
        cache.keeps_worlds_ = true;
        return cache;
    }

    /// That of the user, with worlds: `models` below cache_folder(), of at most VOXELUME_CACHE_MB
    /// megabytes, 4096 without it. Throws Error::usage for one that is no whole number of at least
    /// 0.
    static ModelCache of_user();

    bool is_open() const { return is_open_; }
    bool keeps_worlds() const { return is_open_ && keeps_worlds_; }

    std::optional<MeshSummary> summary(const std::string& source) const;
    void keep(const std::string& source, const MeshSummary& summary, double seconds) const;

    /// The grid on a device. Throws Error::limit when the device has not enough memory.
    std::optional<BrickGrid> grid(const Device& device, const std::string& key) const;
    /// `seconds` is what making it took. One that would take more than an eighth of the cache isn't
    /// kept: few such would drive out all others.
    void keep(const std::string& key, const BrickGrid& grid, double seconds) const;

    /// The same for worlds, without instances; they count by what they take on the device.
    std::optional<Pyramid> world(const Device& device, const std::string& key) const;
    void keep(const std::string& key, const Pyramid& world, double seconds) const;

  private:
    bool is_quick(double seconds, uint64_t bytes) const;

    bool is_open_ = false;
    bool keeps_worlds_ = false;
    DiskCache store_{{}, 0};
    uint64_t max_bytes_ = 0;
    double min_seconds_ = 0;
};

}  // namespace voxelume
