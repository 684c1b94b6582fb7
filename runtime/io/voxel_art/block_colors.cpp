// SPDX-License-Identifier: Apache-2.0
// The colours are averages by eye, rounded to colours that a cube can show; they are no copies of
// textures.
#include "runtime/io/voxel_art/block_colors.hpp"

#include <algorithm>
#include <array>

namespace voxelume {
namespace {

struct Row {
    std::string_view part;  ///< substring of the block's name
    uint32_t rgb;           ///< 0xRRGGBB
    int transparency = 0;   ///< 0..254
};

/// Dyes, by the beginnings of names.
constexpr auto kDyes = std::to_array<Row>({{"white_", 0xE6E9E9},
                                           {"orange_", 0xE37A1F},
                                           {"magenta_", 0xB64AAD},
                                           {"light_blue_", 0x48A8D2},
                                           {"yellow_", 0xEEC332},
                                           {"lime_", 0x74B524},
                                           {"pink_", 0xE491AC},
                                           {"gray_", 0x42474B},
                                           {"light_gray_", 0x8E8E87},
                                           {"cyan_", 0x178A93},
                                           {"purple_", 0x7A2CA8},
                                           {"blue_", 0x383C9C},
                                           {"brown_", 0x70472A},
                                           {"green_", 0x566D1E},
                                           {"red_", 0xA02A24},
                                           {"black_", 0x17171B}});

/// Names of things that dyes colour.
constexpr auto kDyed = std::to_array<std::string_view>(
    {"wool", "carpet", "concrete", "concrete_powder", "terracotta", "glazed_terracotta", "glass",
     "bed", "stained_hardened_clay", "shulker_box", "banner", "stained_glass"});

/// Kinds of wood, by the beginnings of names: planks and things made of them.
constexpr auto kWoods = std::to_array<Row>({{"oak_", 0xA2834F},
                                            {"spruce_", 0x735530},
                                            {"birch_", 0xC3B37B},
                                            {"jungle_", 0xA17451},
                                            {"acacia_", 0xA95B33},
                                            {"dark_oak_", 0x432B14},
                                            {"mangrove_", 0x763631},
                                            {"cherry_", 0xE3B5AE},
                                            {"pale_oak_", 0xE2D8D6},
                                            {"bamboo_", 0xC3AD51},
                                            {"crimson_", 0x663148},
                                            {"warped_", 0x2B6964}});

/// Substrings of names. The longest one in a name decides.
constexpr auto kParts = std::to_array<Row>({
    {"stone", 0x7E7E7E},
    {"cobblestone", 0x7A7A7A},
    {"mossy", 0x6D775F},
    {"granite", 0x95675A},
    {"diorite", 0xBDBDBE},
    {"andesite", 0x888889},
    {"deepslate", 0x515155},
    {"tuff", 0x6C6D66},
    {"calcite", 0xE0E1DD},
    {"dripstone", 0x866B5C},
    {"blackstone", 0x2B252B},
    {"basalt", 0x4D4E54},
    {"bedrock", 0x555555},
    {"dirt", 0x866043},
    {"coarse_dirt", 0x77553B},
    {"rooted_dirt", 0x90674C},
    {"farmland", 0x6F4A2C},
    {"dirt_path", 0x947A41},
    {"grass_path", 0x947A41},
    {"grass_block", 0x6C9A46},
    {"grass", 0x6F9A48},
    {"fern", 0x668F43},
    {"podzol", 0x5C4018},
    {"mycelium", 0x6F6365},
    {"moss", 0x5A6E2D},
    {"mud", 0x3C3A3D},
    {"clay", 0xA1A6B3},
    {"sand", 0xDBCFA3},
    {"sandstone", 0xD8CB9B},
    {"red_sand", 0xBE6721},
    {"red_sandstone", 0xBA631D},
    {"gravel", 0x83807E},
    {"snow", 0xF9FEFE},
    {"ice", 0x91B7FD, 90},
    {"packed_ice", 0x8DB4FA},
    {"blue_ice", 0x74A8FD},
    {"water", 0x3D63C4, 130},
    {"lava", 0xD45A12},
    {"obsidian", 0x100B1A},
    {"netherrack", 0x622626},
    {"nether_brick", 0x2C161A},
    {"nether_wart", 0x730302},
    {"soul_sand", 0x513E33},
    {"soul_soil", 0x4C3A2F},
    {"glowstone", 0xAC8354},
    {"shroomlight", 0xF09347},
    {"magma", 0x8F3F20},
    {"end_stone", 0xDCDF9E},
    {"purpur", 0xA97DA9},
    {"chorus", 0x5D3A5D},
    {"prismarine", 0x64A097},
    {"dark_prismarine", 0x345C4C},
    {"sea_lantern", 0xADC8BF},
    {"sponge", 0xC4C14B},
    {"quartz", 0xECE6DF},
    {"brick", 0x976253},
    {"bricks", 0x976253},
    {"stone_brick", 0x7B7B7B},
    {"terracotta", 0x985E44},
    {"hardened_clay", 0x985E44},
    {"glass", 0xC0D8DE, 190},
    {"tinted_glass", 0x2C262E, 90},
    {"iron_block", 0xDDDDDD},
    {"iron", 0xC4C4C4},
    {"gold", 0xF5CE3E},
    {"diamond", 0x62EDE4},
    {"emerald", 0x2BCB58},
    {"lapis", 0x1F438C},
    {"redstone", 0xAF1905},
    {"coal", 0x151515},
    {"copper", 0xC06C50},
    {"netherite", 0x433D40},
    {"amethyst", 0x8662BF},
    {"ore", 0x7D7A76},
    {"leaves", 0x4C7A28, 0},
    {"spruce_leaves", 0x3E623E},
    {"birch_leaves", 0x617F41},
    {"cherry_leaves", 0xE5ADC2},
    {"azalea", 0x5A7330},
    {"vine", 0x4A7327},
    {"log", 0x6D5533},
    {"wood", 0x6D5533},
    {"stem", 0x5B3047},
    {"birch_log", 0xD8D7D2},
    {"planks", 0xA2834F},
    {"bookshelf", 0x755F3B},
    {"crafting_table", 0x784A2A},
    {"chest", 0x8B6328},
    {"furnace", 0x6E6E6E},
    {"barrel", 0x866439},
    {"hay_block", 0xA68B0C},
    {"pumpkin", 0xC57618},
    {"jack_o_lantern", 0xD69834},
    {"melon", 0x6F911E},
    {"cactus", 0x557F2B},
    {"sugar_cane", 0x94BF65},
    {"bamboo", 0x5D8A2E},
    {"mushroom_stem", 0xCBC4B9},
    {"brown_mushroom", 0x957051},
    {"red_mushroom", 0xC82E2D},
    {"torch", 0xE8C15A},
    {"lantern", 0x6A5B53},
    {"wheat", 0xA69B4A},
    {"bone_block", 0xE2DEC9},
});

constexpr auto kAir =
    std::to_array<std::string_view>({"air", "cave_air", "void_air", "barrier", "structure_void",
                                     "structure_block", "light", "moving_piston", "jigsaw"});

uint32_t from_rgb(uint32_t rgb, int transparency) {
    return (rgb >> 16 & 0xFF) | (rgb & 0xFF00) | (rgb & 0xFF) << 16 | uint32_t(transparency) << 24;
}

const Row* dye_of(std::string_view name) {
    const Row* best = nullptr;
    for (const Row& dye : kDyes) {
        if (!name.starts_with(dye.part)) continue;
        const std::string_view rest = name.substr(dye.part.size());
        const bool is_dyed = std::ranges::any_of(
            kDyed, [&](std::string_view thing) { return rest.starts_with(thing); });
        if (is_dyed && (!best || dye.part.size() > best->part.size())) best = &dye;
    }
    return best;
}

/// True for things made of wood that have no row of their own.
bool is_woodwork(std::string_view rest) {
    constexpr auto kWoodwork = std::to_array<std::string_view>(
        {"planks", "stairs", "slab", "fence", "door", "trapdoor", "pressure_plate", "button",
         "sign", "mosaic", "shelf", "fence_gate", "hanging_sign"});
    return std::ranges::any_of(kWoodwork,
                               [&](std::string_view thing) { return rest.starts_with(thing); });
}

const Row* wood_of(std::string_view name) {
    for (const Row& wood : kWoods)
        if (name.starts_with(wood.part) && is_woodwork(name.substr(wood.part.size()))) return &wood;
    return nullptr;
}

const Row* part_of(std::string_view name) {
    const Row* best = nullptr;
    for (const Row& row : kParts)
        if (name.find(row.part) != std::string_view::npos &&
            (!best || row.part.size() > best->part.size()))
            best = &row;
    return best;
}

/// A colour from the middle of the colour cube, by a hash of the name's letters (FNV-1a).
uint32_t color_of_letters(std::string_view name) {
    uint32_t hash = 2166136261u;
    for (const char c : name) hash = (hash ^ uint8_t(c)) * 16777619u;
    return 0x404040 + (hash & 0x7F7F7F);
}

}  // namespace

BlockColor block_color(std::string_view name) {
    name = name.substr(0, name.find('['));
    if (const size_t colon = name.find(':'); colon != std::string_view::npos)
        name.remove_prefix(colon + 1);
    if (std::ranges::find(kAir, name) != kAir.end()) return {0, true, true};
    if (const Row* dye = dye_of(name))
        return {from_rgb(dye->rgb, name.find("glass") == std::string_view::npos ? 0 : 150), false,
                true};
    if (const Row* wood = wood_of(name)) return {from_rgb(wood->rgb, 0), false, true};
    if (const Row* part = part_of(name))
        return {from_rgb(part->rgb, part->transparency), false, true};
    return {color_of_letters(name), false, false};
}

}  // namespace voxelume
