// SPDX-License-Identifier: Apache-2.0
// Limits of the voxels and bricks of a model from a file.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

namespace voxelume {

class InputFile;

inline constexpr int kMaxVoxelsPerAxis = 65536;
inline constexpr double kMaxBricks = 1 << 28;
inline constexpr size_t kMaxStoredBricks = 1 << 18;  ///< 4 GiB of colours

/// Throws Error::input for more voxels along an axis, or for more bricks, stored or not, than a
/// model may have. A small file may have fewer bricks: an index of them takes memory.
void check_voxel_span(const glm::dvec3& size, const InputFile& file);

/// Throws Error::input for voxels that are shorter than 1e-9 m, or too short to tell neighbours
/// apart at the place of a model.
void check_voxel_edge(const glm::dvec3& voxel_edge, const glm::dvec3& origin,
                      const InputFile& file);

/// Throws Error::input for more stored bricks than a model may have.
void check_stored_bricks(size_t stored, const InputFile& file);

/// The same for a format that lists voxels: for each byte, it has at most four bricks more than
/// 8,192. A solid cube of 512 voxels along each side takes 8 KB as runs, and has 32,768 bricks.
void check_listed_bricks(size_t stored, const InputFile& file);

}  // namespace voxelume
