// SPDX-License-Identifier: Apache-2.0
// Pyramids read back on the host, and compared with the voxels that they should hold.
#pragma once

#include <gtest/gtest.h>

#include <numeric>
#include <optional>
#include <vector>

#include "tests/support/brick_grids.hpp"

namespace voxelume {

/// A pyramid read back to the host, with lookups as grid.hpp documents them.
struct HostPyramid {
    explicit HostPyramid(const Pyramid& p)
        : frame(p.frame),
          sectors(p.sectors.read()),
          bricks(p.bricks.read()),
          leaves(p.leaves.read()),
          leaf_voxels(p.leaf_voxels.read()),
          attributes(p.attributes.read()),
          attribute(p.attribute),
          fields(p.fields.read()) {}

    /// The records of the fields in a voxel: its own, or those that it lists.
    std::vector<uint32_t> fields_in(uint32_t voxel) const {
        const uint32_t kind = word(voxel) >> 30;
        if (kind == 1) return {voxel};
        if (kind == 0 || fields.empty()) return {};
        std::vector<uint32_t> listed(fields.at(voxel * 8 + 1));
        std::iota(listed.begin(), listed.end(), fields.at(voxel * 8));
        return listed;
    }

    /// The voxel's index. Returns nothing for an empty cell, and sets `empty_log2` to the log2 edge
    /// of the cube that is promised to be empty.
    std::optional<uint32_t> find(const glm::ivec3& v, int& empty_log2) const {
        const int sectors_x = (frame.size.x + 63) / 64, sectors_y = (frame.size.y + 63) / 64;
        const uint32_t sector =
            sectors.at(size_t(v.x / 64 + sectors_x * (v.y / 64 + sectors_y * (v.z / 64))));
        if (sector >= 0x80000000u) return empty_log2 = int(sector - 0x80000000u), std::nullopt;
        const int brick_bit = v.x / 16 % 4 + v.y / 16 % 4 * 4 + v.z / 16 % 4 * 16;
        const size_t record = (size_t(sector) * 64 + size_t(brick_bit)) * 4;
        const uint64_t leaf_mask = bricks.at(record) | uint64_t(bricks.at(record + 1)) << 32;
        if (leaf_mask == 0) {
            EXPECT_EQ(bricks.at(record + 2), bricks.at(record + 3));
            return empty_log2 = int(bricks.at(record + 3) - 0x80000000u), std::nullopt;
        }
        const int leaf_bit = v.x / 4 % 4 + v.y / 4 % 4 * 4 + v.z / 4 % 4 * 16;
        if ((leaf_mask >> leaf_bit) % 2 == 0) return empty_log2 = 2, std::nullopt;
        size_t leaf = bricks.at(record + 2 + size_t(leaf_bit / 32));
        for (int bit = leaf_bit & 32; bit < leaf_bit; ++bit) leaf += (leaf_mask >> bit) % 2;
        const uint64_t mask = leaves.at(leaf * 2) | uint64_t(leaves.at(leaf * 2 + 1)) << 32;
        const int voxel_bit = v.x % 4 + v.y % 4 * 4 + v.z % 4 * 16;
        if ((mask >> voxel_bit) % 2 == 0) return empty_log2 = 0, std::nullopt;
        uint32_t voxel = leaf_voxels.at(leaf);
        for (int bit = 0; bit < voxel_bit; ++bit) voxel += (mask >> bit) % 2;
        return voxel;
    }
    uint32_t word(uint32_t voxel) const {
        return attributes.empty() ? attribute : attributes.at(voxel);
    }

    GridFrame frame;
    std::vector<uint32_t> sectors, bricks, leaves, leaf_voxels, attributes;
    uint32_t attribute;
    std::vector<uint32_t> fields;
};

inline bool any_in_cube(const VoxelMap& voxels, const glm::ivec3& v, int log2) {
    const glm::ivec3 low{v.x >> log2 << log2, v.y >> log2 << log2, v.z >> log2 << log2};
    const int edge = 1 << log2;
    for (const auto& [w, word] : voxels)
        if (w.x >= low.x && w.x < low.x + edge && w.y >= low.y && w.y < low.y + edge &&
            w.z >= low.z && w.z < low.z + edge)
            return true;
    return false;
}

/// Checks every voxel of the grid: each is found with its packed attributes and a unique index, and
/// empty cells and cubes are empty.
inline void expect_holds(const Pyramid& pyramid, const VoxelMap& voxels) {
    const HostPyramid host(pyramid);
    ASSERT_EQ(pyramid.voxel_count, voxels.size());
    std::vector<bool> seen(voxels.size());
    std::map<std::array<int, 4>, bool> cube_checked;
    const glm::ivec3 size = pyramid.frame.size;
    for (glm::ivec3 v{0}; v.z < size.z; ++v.z)
        for (v.y = 0; v.y < size.y; ++v.y)
            for (v.x = 0; v.x < size.x; ++v.x) {
                int empty_log2 = -1;
                const std::optional<uint32_t> number = host.find(v, empty_log2);
                const auto expected = voxels.find(v);
                ASSERT_EQ(number.has_value(), expected != voxels.end())
                    << v.x << " " << v.y << " " << v.z;
                if (number) {
                    ASSERT_EQ(host.word(*number), expected->second)
                        << v.x << " " << v.y << " " << v.z;
                    ASSERT_FALSE(seen.at(*number));
                    seen[*number] = true;
                } else if (empty_log2 > 0 && !cube_checked[{v.x >> empty_log2, v.y >> empty_log2,
                                                            v.z >> empty_log2, empty_log2}]) {
                    cube_checked[{v.x >> empty_log2, v.y >> empty_log2, v.z >> empty_log2,
                                  empty_log2}] = true;
                    ASSERT_FALSE(any_in_cube(voxels, v, empty_log2))
                        << v.x << " " << v.y << " " << v.z << " log2 " << empty_log2;
                }
            }
}

}  // namespace voxelume
