// A model whose voxels come from a file: it needs no voxelizing.
#pragma once

#include <string>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/grid/grid.hpp"

namespace voxelume {

/// A BrickGrid in main memory, as it comes from a file.
struct VoxelModel {
    GridFrame frame;
    Surface surface = Surface::cubes;
    VoxelSet set = VoxelSet::supercover;
    std::vector<uint32_t> slots, coordinates;
    std::vector<uint64_t> occupancy;
    std::vector<int16_t> distance;
    std::vector<uint32_t> attributes, colors;
    bool transparent = false;         ///< some voxel isn't opaque
    std::vector<std::string> groups;  ///< what the attributes' materials are named
    Mesh mesh;                        ///< of exact surfaces: their triangles, and nothing else

    size_t voxels() const;  ///< that are occupied, or near a smooth surface
    BrickGrid upload(const Device& device) const;
};

/// Bricks in the table of a frame.
size_t bricks_of(const GridFrame& frame);

}  // namespace voxelume
