// What a pyramid takes of a device's memory.
#pragma once

#include "runtime/grid.hpp"

namespace voxelume {

/// Bytes of all of a pyramid's buffers, its instances' included.
inline uint64_t bytes_of(const Pyramid& p) {
    const auto sum = [](const auto&... buffers) {
        return (uint64_t(buffers.size() * sizeof(buffers.read_one(0))) + ...);
    };
    return sum(p.sectors, p.bricks, p.leaves, p.leaf_voxels, p.attributes, p.colors, p.fields,
               p.primitive_first, p.primitives, p.triangles, p.triangle_attributes, p.solids,
               p.instances.records, p.instances.nodes, p.instances.materials);
}

}  // namespace voxelume
