// SPDX-License-Identifier: Apache-2.0
// The voxels of cubes as a list, for writers of other programs' formats.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/geometry/voxel_model.hpp"
#include "runtime/io/voxels/vox_file.hpp"

namespace voxelume {

/// A material of voxels, as MagicaVoxel has it.
struct CubeMaterial {
    VoxMaterial vox;
    std::optional<uint32_t> color{};  ///< 0xBBGGRR: replaces the voxels' own colours
};

/// Voxels in the smallest box that contains all of them.
struct CubeList {
    glm::ivec3 size{0};             ///< size of the box, voxels
    glm::dvec3 origin{0};           ///< its smallest corner, metres
    glm::dvec3 voxel_edge{1};       ///< metres
    std::vector<glm::ivec3> cells;  ///< from (0, 0, 0) to size - 1, Y up, in any order
    std::vector<uint32_t> colors;   ///< 0xTTBBGGRR, transparency on top; empty: all are white
    std::vector<CubeMaterial> materials;
    std::vector<uint16_t> material_numbers;  ///< material of each voxel; empty: all are plain
};

/// The number of voxels along each axis of the smallest box that contains a model. Throws
/// Error::input for a model without voxels.
glm::ivec3 size_of_cubes(const VoxelModel& model);

/// The inside of a smooth model as cubes, without its colours: the voxels whose middles lie inside.
VoxelModel cubes_inside(const VoxelModel& smooth);

/// The voxels of cubes, including those of full bricks, which have the material of the voxel next
/// to them at -X. `materials` are numbered as in the model's attributes. Throws Error::limit for
/// more than 2^28 voxels.
CubeList cube_list(const VoxelModel& model, std::span<const CubeMaterial> materials = {});

/// Shifts the voxels into the smallest box that contains them all.
void shrink(CubeList& cubes);

// Writers return sentences on what the format couldn't hold. Each writes the file whole or not at
// all, equal bytes for equal voxels, and throws Error::output, or Error::limit for more voxels than
// the format or this program can write.
using WriterNotes = std::vector<std::string>;

/// MagicaVoxel's .vox: a model of at most 256 voxels along each axis, or several side by side. More
/// than 255 colours are reduced to 255 by median cut, separately for each material.
WriterNotes write_vox(const std::filesystem::path& path, const CubeList& cubes);

/// KV6, which stores only the voxels of surfaces.
WriterNotes write_kv6(const std::filesystem::path& path, const CubeList& cubes);

/// binvox, without colours: a cube of cells.
WriterNotes write_binvox(const std::filesystem::path& path, const CubeList& cubes);

/// A numpy array of uint8: (x, y, z) with 0 and 1, or (x, y, z, 4) with colours.
WriterNotes write_npy(const std::filesystem::path& path, const CubeList& cubes);

/// NRRD, gzip: the values of the numpy array, x fastest, with the position in metres.
WriterNotes write_nrrd(const std::filesystem::path& path, const CubeList& cubes);

/// Throws Error::limit where a box of this size has too many coloured voxels for a file of this
/// name, without listing them.
void check_colors(const std::filesystem::path& path, const glm::ivec3& size);

}  // namespace voxelume
