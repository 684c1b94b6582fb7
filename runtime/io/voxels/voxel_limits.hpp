// SPDX-License-Identifier: Apache-2.0
// Limits of the voxels and bricks of a model from a file.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

namespace voxelume {

class InputFile;
struct GridFrame;

inline constexpr int kMaxVoxelsPerAxis = 65536;
inline constexpr double kMaxBricks = 1 << 28;
inline constexpr size_t kMaxStoredBricks = 1 << 18;  ///< 4 GiB of colours

/// Throws Error::input for more voxels along an axis, or for more bricks, stored or not, than a
/// model may have.
void check_voxel_span(const glm::dvec3& size, const InputFile& file);

/// Throws Error::input for voxels that are shorter than 1e-9 m, or too short to tell neighbours
/// apart at the place of a model.
void check_voxel_edge(const glm::dvec3& voxel_edge, const glm::dvec3& origin,
                      const InputFile& file);

/// Throws Error::input for a model that reaches farther than 1e30 m: numbers that are computed from
/// its place would have no room.
void check_reach(const GridFrame& frame, const InputFile& file);

/// Throws Error::input for more stored bricks than a model may have.
void check_stored_bricks(size_t stored, const InputFile& file);

/// These two check the same for formats that list voxels or runs of them, where a small file may
/// have fewer. Its index may have 2^25 bricks and 4,096 more for each byte. It may store 2^14
/// bricks and four more for each byte, which are 256 MB of colours and 64 KB for each byte. A solid
/// cube of 512 voxels along each side takes 8 KB as runs, and has 35,937 bricks.
void check_listed_span(const glm::dvec3& size, const InputFile& file);
void check_listed_bricks(size_t stored, const InputFile& file);

}  // namespace voxelume
