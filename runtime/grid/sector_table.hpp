// SPDX-License-Identifier: Apache-2.0
// The upper levels of an occupancy pyramid: which sectors are stored, and the empty cubes around
// others.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

#include "runtime/grid/grid.hpp"

namespace voxelume {

inline constexpr uint32_t kEmptyCube = 0x80000000u;  ///< | log2 of its edge: see Pyramid
inline constexpr size_t kRecordsPerSector = 64;
inline constexpr size_t kWordsPerRecord = 4;
inline constexpr int kBricksPerSector = kSectorSize / kBrickSize;

/// The sector of brick `b` in a table of `sectors`, and the brick's bit in it.
glm::uvec2 sector_and_bit(const glm::ivec3& b, const glm::ivec3& sectors);

/// Numbers the `occupied` sectors of a table of `size` in ascending order; the others get their
/// empty cube. Returns the number of occupied sectors.
uint32_t number_sectors(const glm::ivec3& size, const std::vector<bool>& occupied,
                        std::vector<uint32_t>& sectors);

/// Gives every brick record whose mask is 0 the size of its empty cube.
void write_empty_cubes(std::vector<uint32_t>& bricks);

}  // namespace voxelume
