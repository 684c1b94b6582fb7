// SPDX-License-Identifier: Apache-2.0
// The voxels of a model, by their cells.
#pragma once

#include <array>
#include <cmath>
#include <map>

#include "runtime/geometry/voxel_model.hpp"

namespace voxelume {

/// What a voxel shows.
struct ShownVoxel {
    uint32_t color = 0;  ///< 0xBBGGRR
    std::string group;   ///< empty in a model without groups
    friend bool operator==(const ShownVoxel&, const ShownVoxel&) = default;
};

/// Keys are the coordinates of a cell's minimum corner.
using VoxelCells = std::map<std::array<int, 3>, ShownVoxel>;

/// The occupied cells of a model whose voxels are 1 long and lie on whole numbers.
inline VoxelCells cells_of(const VoxelModel& model) {
    VoxelCells cells;
    const glm::ivec3 bricks = model.frame.bricks();
    for (size_t slot = 0; slot < model.coordinates.size(); ++slot) {
        const int brick = int(model.coordinates[slot]);
        const glm::ivec3 corner = 16 * glm::ivec3(brick % bricks.x, brick / bricks.x % bricks.y,
                                                  brick / bricks.x / bricks.y);
        for (int z = 0; z < 16; ++z)
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 16; ++x) {
                    const size_t leaf = size_t(x / 4 + y / 4 * 4 + z / 4 * 16);
                    const int bit = x % 4 + y % 4 * 4 + z % 4 * 16;
                    if (!(model.occupancy[slot * 64 + leaf] >> bit & 1)) continue;
                    const size_t index = slot * 4096 + size_t(x + 16 * y + 256 * z);
                    const glm::dvec3 at =
                        model.frame.origin + glm::dvec3(corner) + glm::dvec3(x, y, z);
                    ShownVoxel shown;
                    if (!model.colors.empty()) shown.color = model.colors[index];
                    if (!model.color_codes.empty())
                        shown.color = model.palette[model.color_codes[index]];
                    if (!model.groups.empty())
                        shown.group = model.groups[model.attributes[index] >> 16 & 0x3FFF];
                    cells[{int(std::lround(at.x)), int(std::lround(at.y)),
                           int(std::lround(at.z))}] = shown;
                }
    }
    return cells;
}

}  // namespace voxelume
