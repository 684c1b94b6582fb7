// what a world holds, and how much of it -> the memory of the stages that form and show it.
#pragma once

#include "runtime/memory/plan_extent.hpp"
#include "runtime/memory/plan_grid.hpp"

namespace voxelume {

inline constexpr double kWorldTable = 5;  ///< bytes for each brick of the lattice: slots and states

/// What the voxels of a world have, and those of the models that its instances show.
struct WorldContents {
    GridFrame frame;
    bool smooth = false;    ///< some have distances
    bool occupied = false;  ///< some are occupied, or not
    bool attributes = false, colors = false;
    bool lists = false;  ///< some list their primitives
    double exact_triangles = 0;
    struct {
        bool any = false, smooth = false, colors = false;
        double voxels = 0, min_voxels = 0, exact_voxels = 0, exact_triangles = 0;
    } instances;

    /// Whether each voxel of the pyramid has a word of its own.
    bool has_attributes() const { return attributes || (smooth && occupied) || instances.any; }
};

/// Bytes of the device.
struct StageBytes {
    double place = 0, index = 0;   ///< at the height of these stages
    double world = 0;              ///< of the pyramid, part of the last
    double dilated_occupancy = 0;  ///< of the grid that beams of rays are sent through
};

/// Of a world of such an extent with `instanced` voxels of instances' models, beside `kept` bytes
/// of grids.
StageBytes stage_bytes(const WorldContents& contents, const WorldExtent& extent, double instanced,
                       double kept);

/// The largest buffer of the world, its pyramid's with the models of instances behind it, where it
/// has no more than that extent.
BufferPlan largest_buffer(const WorldContents& contents, const WorldExtent& minimum);

}  // namespace voxelume
