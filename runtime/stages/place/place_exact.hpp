// SPDX-License-Identifier: Apache-2.0
// object grids -> S: joins the primitive lists of exact surfaces.
#pragma once

#include <span>

#include "runtime/stages/place/joined_textures.hpp"
#include "runtime/stages/place/place.hpp"

namespace voxelume {

/// The sizes of what the exact surfaces of a world come from.
struct SourceCounts {
    size_t floats = 0;  ///< of triangles' corners
    size_t solid_words = 0;
    bool normals = false;  ///< some triangle has normals
    JoinedTextures textures;
    bool texture_alpha = false;  ///< the alpha of one of them counts
    bool texture_maps = false;   ///< one of them has maps

    void add(const BrickGrid& grid) {
        textures.add(grid.texture_key, grid.textures.size());
        texture_alpha |= grid.texture_alpha;
        texture_maps |= grid.texture_maps;
        floats += grid.triangles.size();
        solid_words += grid.solids.size();
        normals |= !grid.triangle_normals.empty();
    }
};

/// Makes room in the world for triangles and analytic solids.
void allocate_sources(const Device& device, const SourceCounts& counts, BrickGrid& world);

/// Gives `world`, whose bricks are numbered, the primitives of all exact objects: per voxel in the
/// order of `objects`, with triangles and solids renumbered and their words those of the world.
/// Without exact objects it has none. Throws Error::limit for more than 2^32 list entries.
void join_exact_surfaces(const Device& device, std::span<const PlacedObject> objects,
                         BrickGrid& world);

}  // namespace voxelume
