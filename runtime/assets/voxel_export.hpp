// SPDX-License-Identifier: Apache-2.0
// BrickGrid -> files: voxelume's own model (.vxm) and OpenVDB.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/geometry/voxel_model.hpp"
#include "runtime/grid/grid.hpp"

namespace voxelume {

/// The width of the band around a smooth surface in which other programs expect distances, in the
/// shortest edge of a voxel.
inline constexpr double kExportBand = 3.0;

/// A voxelized mesh in main memory.
///
/// A model file has the arrays of BrickGrid under their names, as far as the grid has them, and the
/// frame, surface and set in its header. A volume has
///   smooth        level set `surface`: signed distances at the voxels' minimum corners, metres
///   cubes, exact  fog `density`: what each voxel of the set covers, at its middle
/// and linear colours `Cd` if the mesh has colours.
class VoxelExport {
  public:
    VoxelExport(const BrickGrid& grid, const Mesh& mesh, Surface surface, VoxelSet set);

    /// Takes cubes; `model` is left without arrays.
    explicit VoxelExport(VoxelModel model);

    /// The voxels of cubes, with their colours and the numbers of their groups of faces.
    VoxelModel cubes() const;
    /// Writes a .vxm file or an OpenVDB file. Both functions throw Error::output.
    void write_model(const std::filesystem::path& path) const;
    void write_vdb(const std::filesystem::path& path) const;

  private:
    struct Cells {
        std::vector<glm::ivec3> cells;
        std::vector<float> values;
        std::vector<glm::vec3> colors;
    };

    void set_header();
    void add_brick(uint32_t slot, Cells& cells) const;
    void add_full_bricks(Cells& cells) const;

    GridFrame frame_;
    Surface surface_;
    std::map<std::string, std::string> header_;
    std::vector<uint32_t> slots_, coordinates_;
    std::vector<uint64_t> occupancy_;
    std::vector<int16_t> distance_;
    std::vector<uint32_t> attributes_, colors_, normals_;
    std::vector<uint32_t> full_colors_;  ///< as in VoxelModel
    std::vector<uint32_t> primitive_first_, primitives_, triangle_attributes_, triangle_normals_;
    std::vector<float> triangles_;
};

/// Writes cubes in the format of the file's name. Returns sentences on what the format couldn't
/// hold. Throws Error::output, and Error::limit for more voxels than the format can hold.
std::vector<std::string> write_cubes(const std::filesystem::path& path, const VoxelExport& voxels);

}  // namespace voxelume
