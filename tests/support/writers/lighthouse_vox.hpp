// SPDX-License-Identifier: Apache-2.0
// The MagicaVoxel file that is shipped with the scenes: a lighthouse on a rock in the sea, with
// glass, metal, a lamp, and waves that are one model each.
#pragma once

#include <cmath>
#include <cstdlib>

#include "tests/support/writers/vox_writer.hpp"

namespace voxelume {

/// The palette indices of its parts.
struct LighthouseColors {
    static constexpr uint8_t rock = 1, dark_rock = 2, grass = 3, white = 4, red = 5, door = 6,
                             glass = 7, lamp = 8, metal = 9, sea = 10, foam = 11, sand = 12;
};

/// A rock of 40 x 40 voxels, which rises to its middle.
inline std::vector<VoxWriter::Voxel> rock_voxels() {
    using C = LighthouseColors;
    std::vector<VoxWriter::Voxel> voxels;
    for (int z = 0; z < 10; ++z)
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x) {
                const int dx = 2 * x - 39, dy = 2 * y - 39;
                const int bumps = (x * 7 + y * 13 + x * y) % 11;
                const int height = 11 - (dx * dx + dy * dy) / 150 - bumps / 6;
                if (z >= height) continue;
                const bool is_top = z == height - 1;
                const uint8_t color = z < 2                ? C::sand
                                      : is_top && z > 5    ? C::grass
                                      : bumps % 3 == z % 3 ? C::dark_rock
                                                           : C::rock;
                voxels.push_back({uint8_t(x), uint8_t(y), uint8_t(z), color});
            }
    return voxels;
}

/// A tower of 17 x 17 x 48 voxels with stripes, a gallery, a lamp behind glass and a roof.
inline std::vector<VoxWriter::Voxel> tower_voxels() {
    using C = LighthouseColors;
    std::vector<VoxWriter::Voxel> voxels;
    for (int z = 0; z < 48; ++z)
        for (int y = 0; y < 17; ++y)
            for (int x = 0; x < 17; ++x) {
                const int squared = (x - 8) * (x - 8) + (y - 8) * (y - 8);
                const auto within = [&](int tenths) { return 100 * squared < tenths * tenths; };
                uint8_t color = 0;
                if (z < 32) {
                    if (within(65 - z / 2)) color = z / 6 % 2 == 0 ? C::white : C::red;
                    if (color != 0 && z < 7 && y < 5 && std::abs(x - 8) < 2) color = C::door;
                } else if (z < 34) {
                    if (within(78)) color = C::metal;
                } else if (z < 41) {
                    if (within(52) && !within(42)) color = C::glass;
                    if (within(22) && z > 34 && z < 40) color = C::lamp;
                    if (within(78) && !within(70) && z < 36) color = C::metal;
                } else if (within(68 - 14 * (z - 41))) {
                    color = C::red;
                } else if (squared == 0) {
                    color = C::metal;
                }
                if (color != 0) voxels.push_back({uint8_t(x), uint8_t(y), uint8_t(z), color});
            }
    return voxels;
}

/// A wave of 12 x 3 x 2 voxels, higher on one side.
inline std::vector<VoxWriter::Voxel> wave_voxels() {
    using C = LighthouseColors;
    std::vector<VoxWriter::Voxel> voxels;
    for (int x = 0; x < 12; ++x)
        for (int y = 0; y < 3; ++y)
            if (std::abs(2 * x - 11) < 12 - 3 * y)
                voxels.push_back({uint8_t(x), uint8_t(y), 0, y == 0 ? C::foam : C::sea});
    for (int x = 3; x < 8; ++x) voxels.push_back({uint8_t(x), 1, 1, C::foam});
    return voxels;
}

inline std::string lighthouse_bytes() {
    using C = LighthouseColors;
    VoxWriter writer;
    writer.model({40, 40, 10}, rock_voxels());
    writer.model({17, 17, 48}, tower_voxels());
    writer.model({12, 3, 2}, wave_voxels());
    std::vector<VoxWriter::Voxel> sea;
    for (int y = 0; y < 72; ++y)
        for (int x = 0; x < 72; ++x) sea.push_back({uint8_t(x), uint8_t(y), 0, C::sea});
    writer.model({72, 72, 1}, sea);
    writer.transform(0, 1, -1, {}, {{}});
    std::vector<int> children = {2, 4, 6};
    const auto place = [&](int node, int model, const std::string& name, const VoxPairs& pose) {
        writer.transform(node, node + 1, 0, {{"_name", name}}, {pose});
        writer.shape(node + 1, {{model, {}}});
    };
    place(2, 3, "sea", {{"_t", "0 0 0"}});
    place(4, 0, "rock", {{"_t", "4 4 6"}});
    place(6, 1, "tower", {{"_t", "5 6 34"}});
    // There are four ways to turn a wave, two of them mirrored.
    const char* poses[][2] = {{"-24 -20 1", "4"}, {"-28 12 1", "17"}, {"10 -28 1", "20"},
                              {"-8 -24 1", "4"},  {"30 -14 1", "33"}, {"-20 4 1", "36"},
                              {"28 26 1", "1"},   {"-26 28 1", "49"}};
    for (int i = 0; i < 8; ++i) {
        children.push_back(8 + 2 * i);
        place(8 + 2 * i, 2, "wave", {{"_r", poses[i][1]}, {"_t", poses[i][0]}});
    }
    writer.group(1, children);
    writer.layer(0, {{"_name", "all"}});
    std::array<uint32_t, 256> colors{};
    const uint32_t chosen[] = {0xFF7D858C, 0xFF5E666E, 0xFF4C9A6B, 0xFFF2F2F2,
                               0xFF2F3AC8, 0xFF2B4A73, 0xFFF0E8D0, 0xFF9CE4FF,
                               0xFF6A6460, 0xFFA8763A, 0xFFF6EEE2, 0xFFA4CCE0};
    for (size_t i = 0; i < std::size(chosen); ++i) colors[i + 1] = chosen[i];
    writer.palette(colors);
    writer.material(C::glass, {{"_type", "_glass"}, {"_trans", "0.9"}, {"_ior", "0.1"}});
    writer.material(C::lamp, {{"_type", "_emit"}, {"_emit", "0.9"}, {"_flux", "1"}});
    writer.material(C::metal, {{"_type", "_metal"}, {"_metal", "0.7"}, {"_rough", "0.3"}});
    return writer.bytes(200);
}

}  // namespace voxelume
