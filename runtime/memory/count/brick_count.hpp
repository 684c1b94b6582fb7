// SPDX-License-Identifier: Apache-2.0
// solid and lattice -> the bricks that its surface is stored in, and its voxels: counted by
// distances, from large cubes of bricks down to those that hold some of it.
#pragma once

#include <span>
#include <vector>

#include "runtime/geometry/surface_extent.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/memory/count/solid_field.hpp"

namespace voxelume {

/// The rule by which a stage stores bricks for a surface.
struct BrickRule {
    double first = 0, last = 0;  ///< the decisive box, in voxels from the brick's corner
    double reach = 0;  ///< maximum distance of the surface from it, in shortest edges of voxels
    bool keeps_inside = false;  ///< bricks inside of the solid are stored, too
    bool fills = false;         ///< all voxels inside of the solid are stored, in stored bricks
    bool closes_ends = false;   ///< the solid has a surface where the lattice ends
    /// The maximum distance of a surface outside of a voxel that still counts as in it, in edges:
    /// at least the rounding error of faces between two layers of voxels, which both meet.
    double cover = 1e-6;

    friend bool operator==(const BrickRule&, const BrickRule&) = default;
};

/// The rules of voxelizing a model in its own space, and of placing it in a world, where a brick
/// extends over `spread` times its edges along the axes of the object.
BrickRule model_rule(Surface surface, bool is_solid_set);
BrickRule world_rule(Surface surface, bool is_solid_set, bool keeps_inside, double spread = 1);

/// The bricks of a lattice that are already stored for some object.
class TakenBricks {
  public:
    explicit TakenBricks(const GridFrame& frame) : table_(frame.bricks()) {}

    /// Takes a brick. Returns true if it was not taken before. In a very large lattice each counts
    /// as new.
    bool take(const glm::ivec3& brick);

  private:
    glm::ivec3 table_;
    std::vector<bool> taken_;  ///< empty before the first brick
};

/// The numbers of voxels of a solid's surface, of its bricks, and of bricks that weren't taken
/// before.
struct BrickCount {
    SurfaceExtent extent;
    double new_bricks = 0;
};

/// Counts a solid's surface in the `box` of `frame`'s voxels by this rule. Large surfaces are
/// counted in coarser lattices. A voxel counts once for each of the solid's `parts` whose surface
/// is in it.
BrickCount count_bricks(const SolidField& field, const GridFrame& frame, const VoxelBox& box,
                        const BrickRule& rule, TakenBricks& taken,
                        std::span<const SolidField> parts = {});

/// Counts a smooth solid likewise: each of its parts has bricks of its own, and voxels in which
/// parts meet have a field of each.
BrickCount count_parts(const Solid& solid, const glm::dmat4& frame_from_solid,
                       const GridFrame& frame, const VoxelBox& box, const BrickRule& rule,
                       TakenBricks& taken);

}  // namespace voxelume
