// SPDX-License-Identifier: Apache-2.0
// The numbers that Minecraft's blocks had before version 1.13, and their names.
#include <array>

#include "runtime/io/voxel_art/block_colors.hpp"

namespace voxelume {
namespace {

/// A block with a number of 100 or more.
struct NumberedBlock {
    int number;
    std::string_view name;
};

// clang-format off
constexpr auto kBlockNames = std::to_array<std::string_view>({
    "air", "stone", "grass_block", "dirt", "cobblestone", "oak_planks", "sapling", "bedrock",
    "water", "water", "lava", "lava", "sand", "gravel", "gold_ore", "iron_ore", "coal_ore",
    "oak_log", "oak_leaves", "sponge", "glass", "lapis_ore", "lapis_block", "dispenser",
    "sandstone", "note_block", "red_bed", "gold_rail", "iron_rail", "sticky_piston", "cobweb",
    "grass", "dead_bush", "piston", "piston_head", "white_wool", "moving_piston", "dandelion",
    "poppy", "brown_mushroom", "red_mushroom", "gold_block", "iron_block", "stone_slab",
    "stone_slab", "bricks", "tnt", "bookshelf", "mossy_cobblestone", "obsidian", "torch", "fire",
    "spawner", "oak_stairs", "chest", "redstone_wire", "diamond_ore", "diamond_block",
    "crafting_table", "wheat", "farmland", "furnace", "furnace", "oak_sign", "oak_door",
    "ladder", "rail", "cobblestone_stairs", "oak_sign", "lever", "stone_pressure_plate",
    "iron_door", "oak_pressure_plate", "redstone_ore", "redstone_ore", "redstone_torch",
    "redstone_torch", "stone_button", "snow", "ice", "snow_block", "cactus", "clay",
    "sugar_cane", "jukebox", "oak_fence", "pumpkin", "netherrack", "soul_sand", "glowstone",
    "portal", "jack_o_lantern", "cake", "repeater", "repeater", "white_stained_glass",
    "oak_trapdoor", "stone", "stone_bricks", "brown_mushroom"});
constexpr auto kLaterBlocks = std::to_array<NumberedBlock>({
    {100, "red_mushroom"}, {101, "iron_bars"}, {102, "glass"}, {103, "melon"}, {106, "vine"},
    {107, "oak_fence_gate"}, {108, "brick_stairs"}, {109, "stone_brick_stairs"},
    {110, "mycelium"}, {112, "nether_bricks"}, {114, "nether_brick_stairs"}, {121, "end_stone"},
    {125, "oak_slab"}, {126, "oak_slab"}, {128, "sandstone_stairs"}, {129, "emerald_ore"},
    {133, "emerald_block"}, {134, "spruce_stairs"}, {135, "birch_stairs"},
    {136, "jungle_stairs"}, {139, "cobblestone_wall"}, {152, "redstone_block"},
    {155, "quartz_block"}, {156, "quartz_stairs"}, {159, "white_terracotta"},
    {161, "acacia_leaves"}, {162, "acacia_log"}, {168, "prismarine"}, {169, "sea_lantern"},
    {170, "hay_block"}, {172, "terracotta"}, {173, "coal_block"}, {174, "packed_ice"}});
constexpr auto kWoolNames = std::to_array<std::string_view>({
    "white_wool", "orange_wool", "magenta_wool", "light_blue_wool", "yellow_wool", "lime_wool",
    "pink_wool", "gray_wool", "light_gray_wool", "cyan_wool", "purple_wool", "blue_wool",
    "brown_wool", "green_wool", "red_wool", "black_wool"});
constexpr auto kPlankNames = std::to_array<std::string_view>({
    "oak_planks", "spruce_planks", "birch_planks", "jungle_planks", "acacia_planks",
    "dark_oak_planks"});
// clang-format on

}  // namespace

std::string_view name_of_block(int number, int data) {
    // Wool, stained clay, carpet and concrete have their dye in the data.
    if (number == 35 || number == 159 || number == 171 || number == 251 || number == 252)
        return kWoolNames[size_t(data & 15)];
    if (number == 5) return kPlankNames[size_t(data & 7) % kPlankNames.size()];
    if (number >= 0 && size_t(number) < kBlockNames.size()) return kBlockNames[size_t(number)];
    for (const NumberedBlock& row : kLaterBlocks)
        if (row.number == number) return row.name;
    return {};
}

}  // namespace voxelume
