// SPDX-License-Identifier: Apache-2.0
// bytes of an array -> the bytes of a brick, in the model's order
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace voxelume {

/// The cells of a brick within an array of bytes.
struct ByteBrick {
    const uint8_t* first;
    size_t row, layer;  ///< bytes from one row, or layer, to the next
    glm::ivec3 count;   ///< cells along the file's axes, 16 at most
};

/// The part that a cell's coordinate along each of the file's axes adds to its index in a brick.
using OffsetsInBrick = std::array<std::array<uint32_t, 16>, 3>;

/// Writes 4096 bytes, those without a cell as 0.
void write_codes(const ByteBrick& brick, const OffsetsInBrick& offsets, uint8_t* codes);

}  // namespace voxelume
