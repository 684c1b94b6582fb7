// model -> what voxelizing it takes: its grid's memory, and the largest buffer of it.
#pragma once

#include <cstdint>

#include "runtime/assets/model_frame.hpp"
#include "runtime/geometry/surface_extent.hpp"
#include "runtime/geometry/voxel_model.hpp"
#include "runtime/grid/grid_frame.hpp"

namespace voxelume {

// Bytes that a stored brick of 16³ voxels takes.
inline constexpr double kOccupancyBytes = 512;  ///< a bit for each voxel
inline constexpr double kDistanceBytes = 8192;  ///< 2 bytes for each node
inline constexpr double kWordBytes = 16384;     ///< 4 for each voxel: attributes, colours, lists

inline constexpr double kTableBytes = 12;  ///< a model's brick, stored or not, while it is made

inline constexpr double kTriangleBytes = 36;       ///< the corners of an exact surface's triangle
inline constexpr double kExactTriangleBytes = 40;  ///< with its word
inline constexpr double kListBytes = 10;           ///< a voxel's list of primitives

inline constexpr double kSurfaceBand = 2.8;  ///< voxels around a smooth surface with distances

/// What makes a buffer smaller.
enum class BufferGrowth : uint8_t {
    surface,   ///< larger voxels, with the square of their edge
    table,     ///< larger voxels, with the cube
    triangles  ///< fewer triangles
};

/// A buffer, which lies in one piece on a device.
struct BufferPlan {
    const char* name = "";  ///< what it holds: "its distances"
    double bytes = 0;
    BufferGrowth growth = BufferGrowth::surface;
};

/// Keeps the larger of two.
void keep_larger(BufferPlan& largest, const BufferPlan& buffer);

/// Of a grid, at least: less than planned where a solid's parts may lie in each other.
struct MinGrid {
    double voxels = 0, made_bytes = 0, kept_bytes = 0;
};

/// One grid that is voxelized: a model's, or an exact object's in the world's lattice.
struct GridPlan {
    int model = 0;
    int object = -1;  ///< whose grid it is alone; -1 for a model's, which objects share
    GridFrame frame;
    uint64_t triangles = 0;
    double voxels = 0;        ///< surface voxels
    double bricks = 0;        ///< stored
    double made_bytes = 0;    ///< device memory while it is made, its own included
    double kept_bytes = 0;    ///< device memory that it keeps until the world is formed
    MinGrid minimum = {};     ///< of these three
    BufferPlan largest = {};  ///< of the buffers that it takes while it is made
};

/// Takes what a grid needs at least, and its largest buffer, from another plan for it.
void set_minimum(GridPlan& grid, const GridPlan& minimum);

/// What the voxels of a model carry besides their place.
struct GridExtras {
    bool attributes = false, colors = false;
};

/// `mesh` is null for a model that has none.
GridExtras extras_of(const Model& model, const MeshSummary* mesh);

/// The area of a model's surface in its own space.
SurfaceArea model_area(const Model& model, const MeshSummary* mesh);

/// Bricks of a lattice, stored or not.
double brick_table(const GridFrame& frame);

/// The memory of a grid whose surface is as large as `extent`.
GridPlan plan_grid(const Model& model, const MeshSummary* mesh, const GridFrame& frame,
                   const SurfaceExtent& extent);

/// The memory of a model in its own space. Throws as model_frame does.
GridPlan plan_grid(const Model& model, const MeshSummary* mesh, const SurfaceArea& area);

/// The memory of voxels from a file.
GridPlan plan_grid(const VoxelModel& voxels);

}  // namespace voxelume
