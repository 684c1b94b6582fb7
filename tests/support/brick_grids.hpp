// SPDX-License-Identifier: Apache-2.0
// Brick grids written by hand for tests, from sets of voxels or from distances at nodes.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "runtime/grid/grid.hpp"

namespace voxelume {

struct VoxelOrder {
    bool operator()(const glm::ivec3& a, const glm::ivec3& b) const {
        return std::array{a.z, a.y, a.x} < std::array{b.z, b.y, b.x};
    }
};

/// Voxels and their packed attributes.
using VoxelMap = std::map<glm::ivec3, uint32_t, VoxelOrder>;

inline GridFrame frame_of(const glm::ivec3& size) {
    GridFrame frame;
    frame.size = size;
    return frame;
}

/// The buffers of a BrickGrid on the host; `upload` copies what is filled.
struct HostBricks {
    explicit HostBricks(const GridFrame& grid_frame) : frame(grid_frame) {
        const glm::ivec3 n = frame.bricks();
        slots.assign(size_t(n.x) * size_t(n.y) * size_t(n.z), kBrickOutside);
    }

    size_t brick_index(const glm::ivec3& voxel) const {
        const glm::ivec3 n = frame.bricks(), b = voxel / 16;
        return size_t(b.x) + size_t(n.x) * (size_t(b.y) + size_t(n.y) * size_t(b.z));
    }
    static size_t index_in_brick(const glm::ivec3& voxel) {
        return size_t(voxel.x % 16 + 16 * (voxel.y % 16) + 256 * (voxel.z % 16));
    }
    /// Gives slots to the bricks marked by slot 0, in ascending order.
    void number_slots() {
        for (size_t i = 0; i < slots.size(); ++i)
            if (slots[i] == 0) {
                slots[i] = uint32_t(coordinates.size());
                coordinates.push_back(uint32_t(i));
            }
    }
    size_t index_of(const glm::ivec3& voxel) const {
        return size_t(slots[brick_index(voxel)]) * 4096 + index_in_brick(voxel);
    }
    BrickGrid upload(const Device& device) const {
        BrickGrid grid;
        grid.frame = frame;
        grid.brick_count = uint32_t(coordinates.size());
        grid.slots = {device, "slots", slots};
        grid.coordinates = {device, "coordinates", coordinates};
        grid.occupancy = {device, "occupancy", occupancy};
        grid.distance = {device, "distance", distance};
        grid.attributes = {device, "attributes", attributes};
        grid.colors = {device, "colors", colors};
        return grid;
    }

    GridFrame frame;
    std::vector<uint32_t> slots, coordinates;
    std::vector<uint64_t> occupancy;
    std::vector<int16_t> distance;
    std::vector<uint32_t> attributes, colors;
};

/// Bricks that hold `voxels` with their packed attributes.
inline HostBricks occupied_bricks(const GridFrame& frame, const VoxelMap& voxels) {
    HostBricks bricks(frame);
    for (const auto& [voxel, word] : voxels) bricks.slots[bricks.brick_index(voxel)] = 0;
    bricks.number_slots();
    bricks.occupancy.assign(bricks.coordinates.size() * 64, 0);
    bricks.attributes.assign(bricks.coordinates.size() * 4096, 0);
    for (const auto& [v, word] : voxels) {
        const size_t index = bricks.index_of(v);
        const glm::ivec3 leaf = v % 16 / 4, in = v % 4;
        bricks.occupancy[index / 4096 * 64 + size_t(leaf.x + 4 * leaf.y + 16 * leaf.z)] |=
            uint64_t{1} << (in.x + 4 * in.y + 16 * in.z);
        bricks.attributes[index] = word;
    }
    return bricks;
}

/// Bricks that hold `voxels` without attributes.
inline HostBricks bare_bricks(const GridFrame& frame, const std::vector<glm::ivec3>& voxels) {
    VoxelMap words;
    for (const glm::ivec3& voxel : voxels) words[voxel] = 0;
    HostBricks bricks = occupied_bricks(frame, words);
    bricks.attributes.clear();
    return bricks;
}

using NodeDistance = std::function<int16_t(const glm::ivec3&)>;

/// Bricks with a node that is not saturated; the others are inside or outside.
inline HostBricks distance_bricks(const GridFrame& frame, const NodeDistance& distance_at) {
    HostBricks bricks(frame);
    const glm::ivec3 n = frame.bricks();
    const glm::ivec3 nodes = n * 16;
    std::vector<int16_t> dense;
    dense.reserve(size_t(nodes.x) * size_t(nodes.y) * size_t(nodes.z));
    for (int z = 0; z < nodes.z; ++z)
        for (int y = 0; y < nodes.y; ++y)
            for (int x = 0; x < nodes.x; ++x) {
                const int16_t f = distance_at({x, y, z});
                dense.push_back(f);
                uint32_t& slot = bricks.slots[bricks.brick_index({x, y, z})];
                if (std::abs(f) < 32767) slot = 0;
                if (f == -32767 && slot == kBrickOutside) slot = kBrickInside;
            }
    bricks.number_slots();
    bricks.distance.assign(bricks.coordinates.size() * 4096, 0);
    size_t i = 0;
    for (int z = 0; z < nodes.z; ++z)
        for (int y = 0; y < nodes.y; ++y)
            for (int x = 0; x < nodes.x; ++x, ++i)
                if (bricks.slots[bricks.brick_index({x, y, z})] < kBrickInside)
                    bricks.distance[bricks.index_of({x, y, z})] = dense[i];
    return bricks;
}

/// A distance in voxels as a node stores it.
inline int16_t stored_distance(double voxels) {
    return int16_t(std::lround(std::clamp(voxels * 8192.0, -32767.0, 32767.0)));
}

/// A BrickGrid's voxels and distances read back.
struct ReadBricks {
    explicit ReadBricks(const BrickGrid& grid) : host(grid.frame), attribute(grid.attribute) {
        host.slots = grid.slots.read();
        host.coordinates = grid.coordinates.read();
        host.occupancy = grid.occupancy.read();
        host.distance = grid.distance.read();
        host.attributes = grid.attributes.read();
        host.colors = grid.colors.read();
    }
    uint32_t slot(const glm::ivec3& v) const { return host.slots[host.brick_index(v)]; }
    bool is_set(const glm::ivec3& v) const {
        if (slot(v) >= kBrickInside) return slot(v) == kBrickInside;
        const glm::ivec3 leaf = v % 16 / 4, in = v % 4;
        return host.occupancy[host.index_of(v) / 4096 * 64 +
                              size_t(leaf.x + 4 * leaf.y + 16 * leaf.z)] >>
                   (in.x + 4 * in.y + 16 * in.z) &
               1;
    }
    int distance_at(const glm::ivec3& node) const {
        if (slot(node) >= kBrickInside) return slot(node) == kBrickInside ? -32767 : 32767;
        return host.distance[host.index_of(node)];
    }
    uint32_t word(const glm::ivec3& v) const {
        return host.attributes.empty() ? attribute : host.attributes[host.index_of(v)];
    }
    /// Every set voxel, with its packed attributes unless its brick is full.
    VoxelMap voxels() const {
        VoxelMap set;
        for (glm::ivec3 v{0}; v.z < host.frame.size.z; ++v.z)
            for (v.y = 0; v.y < host.frame.size.y; ++v.y)
                for (v.x = 0; v.x < host.frame.size.x; ++v.x)
                    if (is_set(v)) set[v] = slot(v) < kBrickInside ? word(v) : attribute;
        return set;
    }

    HostBricks host;
    uint32_t attribute;
};

}  // namespace voxelume
