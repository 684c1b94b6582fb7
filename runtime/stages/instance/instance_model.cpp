// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/instance/instance_model.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "runtime/grid/sector_table.hpp"
#include "runtime/stages/index/index.hpp"

namespace voxelume {
namespace {

/// The first and the last of the coordinates 0..3 along an axis at which a 64-bit mask has a bit.
glm::ivec2 span_of(uint64_t mask, int axis) {
    constexpr uint64_t kFirst[3] = {0x1111111111111111ull, 0x000F000F000F000Full, 0xFFFFull};
    glm::ivec2 span{4, -1};
    for (int i = 0; i < 4; ++i)
        if (mask & kFirst[axis] << (i << (2 * axis))) span = {std::min(span.x, i), i};
    return span;
}

glm::ivec3 cell_of_bit(size_t bit) {
    return {int(bit & 3), int(bit >> 2 & 3), int(bit >> 4)};
}

void add_brick(const uint32_t* record, const std::vector<uint32_t>& leaves,
               const glm::ivec3& corner, ModelPyramid& model) {
    const uint64_t mask = record[0] | uint64_t(record[1]) << 32;
    size_t leaf = record[2];
    for (size_t bit = 0; bit < 64; ++bit) {
        if (!(mask >> bit & 1)) continue;
        const uint64_t voxels = leaves[2 * leaf] | uint64_t(leaves[2 * leaf + 1]) << 32;
        ++leaf;
        const glm::ivec3 first = corner + cell_of_bit(bit) * kLeafSize;
        for (int axis = 0; axis < 3; ++axis) {
            const glm::ivec2 span = span_of(voxels, axis);
            if (span.y < 0) continue;
            model.low[axis] = std::min(model.low[axis], first[axis] + span.x);
            model.high[axis] = std::max(model.high[axis], first[axis] + span.y + 1);
        }
    }
}

void find_box(ModelPyramid& model) {
    const Pyramid& p = model.pyramid;
    const std::vector<uint32_t> sectors = p.sectors.read(), bricks = p.bricks.read(),
                                leaves = p.leaves.read();
    const glm::ivec3 table = p.frame.sectors();
    model.low = p.frame.size;
    model.high = glm::ivec3(0);
    for (size_t sector = 0; sector < sectors.size(); ++sector) {
        if (sectors[sector] & kEmptyCube) continue;
        const auto s = int(sector);
        const glm::ivec3 corner =
            glm::ivec3(s % table.x, s / table.x % table.y, s / (table.x * table.y)) * kSectorSize;
        for (size_t bit = 0; bit < kRecordsPerSector; ++bit) {
            const size_t record = sectors[sector] * kRecordsPerSector + bit;
            add_brick(&bricks[record * kWordsPerRecord], leaves,
                      corner + cell_of_bit(bit) * kBrickSize, model);
        }
    }
    model.high = glm::min(model.high, p.frame.size);
}

/// The parts of a solid, as fields of a world in their own frame.
PlacedWorld world_of_parts(const BrickGrid& grid) {
    PlacedWorld world;
    world.voxels.frame = grid.frame;
    world.ranks = {0};
    world.fields.push_back({.grid = grid, .place = grid.place, .version = 0});
    for (const GridPart& part : grid.parts)
        world.fields.push_back({.grid = *part.grid,
                                .place = part.place,
                                .is_first = false,
                                .version = world.fields.size()});
    return world;
}

}  // namespace

ModelPyramid index_model(const Device& device, const BrickGrid& grid) {
    ModelPyramid model{.pyramid = grid.parts.empty()
                                      ? build_index(device, grid)
                                      : FieldIndexer(device).index(world_of_parts(grid))};
    find_box(model);
    return model;
}

}  // namespace voxelume
