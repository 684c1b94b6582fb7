// SPDX-License-Identifier: Apache-2.0
// A model whose voxels come from a file: it needs no voxelizing.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "runtime/base/huge_pages.hpp"
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
    std::vector<uint32_t> attributes, colors, normals;
    /// The palette entry of each voxel, in place of `colors` for few colours: it takes a fourth of
    /// the memory, and memory takes longer to fill than files to read.
    UnfilledVector<uint8_t> color_codes;
    std::array<uint32_t, 256> palette{};
    std::vector<uint32_t> full_colors;  ///< by brick: those of bricks that are full; empty: white
    bool transparent = false;           ///< true if some voxel isn't opaque
    std::vector<std::string> groups;    ///< names of the attributes' materials
    Mesh mesh;                          ///< triangles of an exact surface, and nothing else

    bool has_colors() const { return !colors.empty() || !color_codes.empty(); }
    /// Makes colours of codes, if there are any.
    void widen_colors();
    size_t voxels() const;  ///< number of voxels that are occupied, or near a smooth surface
    BrickGrid upload(const Device& device) const;
};

/// The number of bricks in a frame's table.
size_t bricks_of(const GridFrame& frame);

}  // namespace voxelume
