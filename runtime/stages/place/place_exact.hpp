// SPDX-License-Identifier: Apache-2.0
// object grids -> S: joins the primitive lists of exact surfaces.
#pragma once

#include <span>

#include "runtime/stages/place/joined_textures.hpp"
#include "runtime/stages/place/place.hpp"

namespace voxelume {

/// The sizes of the triangles and solids of a world's exact surfaces.
struct SourceCounts {
    size_t floats = 0;  ///< floats of triangles' corners
    size_t solid_words = 0;
    bool normals = false;  ///< some triangle has normals
    JoinedTextures textures;
    bool texture_alpha = false;  ///< the alpha of some texture counts
    bool texture_maps = false;   ///< some texture has maps

    void add(const BrickGrid& grid) {
        textures.add(grid.texture_key, grid.textures.size());
        texture_alpha |= grid.texture_alpha;
        texture_maps |= grid.texture_maps;
        floats += grid.triangles.size();
        solid_words += grid.solids.size();
        normals |= !grid.triangle_normals.empty();
    }
};

/// Allocates the world's buffers of triangles and analytic solids.
void allocate_sources(const Device& device, const SourceCounts& counts, BrickGrid& world);

/// Sets the primitive lists of `world`, whose bricks are numbered: per voxel in the order of
/// `objects`, with triangles and solids renumbered and their attributes converted to the world's.
/// Without exact objects there are none. Throws Error::limit for more than 2^32 list entries.
void join_exact_surfaces(const Device& device, std::span<const PlacedObject> objects,
                         BrickGrid& world);

}  // namespace voxelume
