// SPDX-License-Identifier: Apache-2.0
// The results of processing models' meshes, and the worlds made from them. They are kept on disk
// between runs under a hash of everything that they come from.
#pragma once

#include <glm/mat4x4.hpp>

#include <optional>
#include <string>
#include <vector>

#include "runtime/base/files/disk_cache.hpp"
#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/geometry/shape/mesh_shape.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/stages/voxelize/voxelize_options.hpp"

namespace voxelume {

struct VoxelModel;

/// Names the bytes of a mesh file and of the files that it leads to, and so the mesh that they are
/// read as. Only the extension of the file's own name counts.
std::string mesh_source(const std::string& bytes, const std::filesystem::path& name);
/// Names a part of the mesh that `source` names; 0 stands for all of it.
std::string part_source(const std::string& source, int part);

/// Names the mesh of a source after a map.
std::string mapped_source(const std::string& source, const FileMap& map);

/// Names the mesh of a source without its parts that are too thin for voxels of `voxel_edge`, or
/// the mesh of these parts alone.
std::string thin_source(const std::string& source, double voxel_edge, bool is_thin_part);

/// Names a mesh that is morphed from one source to another; `to` is empty for a sphere.
std::string morph_source(const std::string& from, const std::string& to, const Morph& morph);

/// Names voxels without triangles.
std::string voxels_source(const VoxelModel& voxels);

/// Names the voxels of the mesh that `source` names. The name is equal on all devices, because
/// their bits are equal.
std::string grid_key(const std::string& source, const VoxelizeOptions& options,
                     const glm::dmat4& frame_from_mesh, const GridFrame& frame);

/// Names the voxels of a world whose sources are named by `parts`.
std::string world_key(std::string_view parts);

/// Summaries and voxels of meshes, and worlds, on disk. Any number of processes may share them.
///
/// Entries are those of DiskCache: whole or absent, and absent once damaged. Their names come from
/// their sources and from the code that makes them, so no entry is ever out of date. Results that
/// are made as quickly as they would be read aren't kept.
class ModelCache {
  public:
    /// Makes a cache that keeps nothing.
    ModelCache() = default;
    /// Makes a cache of up to `max_bytes` for results that take at least `min_seconds` to make.
    /// `bases` are folders that are only read.
    ModelCache(std::filesystem::path folder, uint64_t max_bytes, double min_seconds = 0.001,
               std::vector<std::filesystem::path> bases = {})
        : is_open_((!folder.empty() || !bases.empty()) && max_bytes > 0),
          store_(std::move(folder), max_bytes, std::move(bases)),
          max_bytes_(max_bytes),
          min_seconds_(min_seconds) {}

    /// A copy of this cache that also keeps worlds.
    ModelCache with_worlds() const {
        ModelCache cache = *this;
        cache.keeps_worlds_ = true;
        return cache;
    }

    /// The user's cache, with worlds: `models` below cache_folder(), of at most VOXELUME_CACHE_MB
    /// megabytes; 4096 if that isn't set. Throws Error::usage for a value that is no whole number
    /// of at least 0.
    static ModelCache of_user();

    /// The user's cache with another folder, unless `folder` is empty, and another limit, if
    /// `megabytes` has a value.
    static ModelCache of_user(const std::filesystem::path& folder,
                              std::optional<uint64_t> megabytes);

    bool is_open() const { return is_open_; }
    /// The reason why nothing can be written, as DiskCache has it; empty for a cache that isn't
    /// open, whose folder isn't used.
    std::string refusal() const { return is_open_ ? store_.refusal() : std::string(); }
    const std::filesystem::path& folder() const { return store_.folder(); }
    bool keeps_worlds() const { return is_open_ && keeps_worlds_; }

    std::optional<MeshSummary> summary(const std::string& source) const;
    void keep(const std::string& source, const MeshSummary& summary, double seconds) const;

    /// The next two do the same for the shape of a mesh, on which its surface depends.
    std::optional<MeshShape> shape(const std::string& source) const;
    void keep(const std::string& source, const MeshShape& shape, double seconds) const;

    /// The grid on a device; empty if the cache doesn't have it. Throws Error::limit if the device
    /// has too little memory.
    std::optional<BrickGrid> grid(const Device& device, const std::string& key) const;
    /// Keeps a grid that took `seconds` to make. A grid that would take more than an eighth of the
    /// cache is kept when it is made for the second time, for a few such grids displace all other
    /// entries; one that would take more than half of it never is.
    void keep(const std::string& key, const BrickGrid& grid, double seconds) const;

    /// The next two do the same for worlds without instances. Worlds count by the bytes that they
    /// take on the device.
    std::optional<Pyramid> world(const Device& device, const std::string& key) const;
    void keep(const std::string& key, const Pyramid& world, double seconds) const;
    /// True if a world that took `seconds` to make is worth keeping for its time, but exceeds the
    /// limit of size.
    bool is_too_large(uint64_t bytes, double seconds) const;
    uint64_t max_entry_bytes() const { return max_bytes_ / 2; }

    /// The winding number of the mesh that `source` names around a point, if it is known.
    std::optional<double> winding(const std::string& source, const glm::dvec3& point) const;
    void keep(const std::string& source, const glm::dvec3& point, double winding,
              double seconds) const;

  private:
    bool is_quick(double seconds, uint64_t bytes) const;
    uint64_t max_new_entry_bytes() const { return max_bytes_ / 8; }
    bool was_made_before(const std::string& key) const;

    bool is_open_ = false;
    bool keeps_worlds_ = false;
    DiskCache store_{{}, 0};
    uint64_t max_bytes_ = 0;
    double min_seconds_ = 0;
};

}  // namespace voxelume
