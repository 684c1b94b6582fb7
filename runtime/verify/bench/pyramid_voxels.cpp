// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/pyramid_voxels.hpp"

#include <bit>
#include <vector>

namespace voxelume {
namespace {

constexpr uint32_t kNothing = 0x80000000u;  ///< an empty cube in tables of sectors

/// The position of a child that a mask's bit stands for.
glm::ivec3 index_of(int bit) {
    return {bit & 3, bit >> 2 & 3, bit >> 4};
}

/// Calls `visit` with each set bit of a mask, from the lowest on.
template <class Visit>
void for_bits(uint64_t mask, const Visit& visit) {
    for (; mask != 0; mask &= mask - 1) visit(std::countr_zero(mask));
}

uint64_t mask_at(const std::vector<uint32_t>& words, size_t first) {
    return words[first] | uint64_t(words[first + 1]) << 32;
}

}  // namespace

PyramidPart shown_part(const Pyramid& pyramid) {
    if (pyramid.instances.empty()) return {pyramid.frame, 0};
    const InstanceModel& model = pyramid.instances.models.front();
    return {model.frame, model.first_sector};
}

void for_voxels(const Pyramid& pyramid, const PyramidPart& part,
                const std::function<void(const glm::ivec3&, uint32_t)>& visit) {
    const std::vector<uint32_t> sectors = pyramid.sectors.read(), bricks = pyramid.bricks.read(),
                                leaves = pyramid.leaves.read(),
                                leaf_voxels = pyramid.leaf_voxels.read();
    const auto visit_leaf = [&](const glm::ivec3& corner, uint32_t leaf) {
        uint32_t number = leaf_voxels[leaf];
        for_bits(mask_at(leaves, size_t(leaf) * 2),
                 [&](int bit) { visit(corner + index_of(bit), number++); });
    };
    const auto visit_brick = [&](const glm::ivec3& corner, size_t record) {
        const uint64_t mask = mask_at(bricks, record);
        if (mask == 0) return;
        uint32_t leaf = bricks[record + 2];
        for_bits(mask, [&](int bit) { visit_leaf(corner + 4 * index_of(bit), leaf++); });
    };
    const glm::ivec3 n = part.frame.sectors();
    size_t sector = part.first_sector;
    for (glm::ivec3 s{0}; s.z < n.z; ++s.z)
        for (s.y = 0; s.y < n.y; ++s.y)
            for (s.x = 0; s.x < n.x; ++s.x, ++sector) {
                if (sectors[sector] >= kNothing) continue;
                for (int bit = 0; bit < 64; ++bit)
                    visit_brick(kSectorSize * s + kBrickSize * index_of(bit),
                                (size_t(sectors[sector]) * 64 + size_t(bit)) * 4);
            }
}

}  // namespace voxelume
