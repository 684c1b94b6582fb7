// SPDX-License-Identifier: Apache-2.0
// Names of Minecraft's blocks -> colours.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace voxelume {

struct BlockColor {
    uint32_t color = 0;    ///< 0xTTBBGGRR, with the transparency on top
    bool is_air = false;   ///< there is no block
    bool is_known = true;  ///< otherwise the colour comes from a hash of the name
};

/// The colour of a block by its name, as in "minecraft:oak_log[axis=y]". Every unknown name always
/// gets its same colour.
BlockColor block_color(std::string_view name);

/// The name of a block before Minecraft 1.13, by its number and its data; empty for unknown ones.
std::string_view name_of_block(int number, int data);

}  // namespace voxelume
