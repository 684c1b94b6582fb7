// SPDX-License-Identifier: Apache-2.0
// The memory for voxelizing a model: its grid and its largest buffer.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/assets/model_frame.hpp"
#include "runtime/geometry/surface_extent.hpp"
#include "runtime/geometry/voxel_model.hpp"
#include "runtime/grid/grid_frame.hpp"

namespace voxelume {

/// The remedy that makes a buffer smaller.
enum class BufferGrowth : uint8_t {
    surface,   ///< larger voxels, with the square of their edge
    table,     ///< larger voxels, with the cube
    triangles  ///< fewer triangles
};

/// A buffer, which lies in one piece on a device.
struct BufferPlan {
    const char* name = "";  ///< its content: "its distances"
    double bytes = 0;
    BufferGrowth growth = BufferGrowth::surface;
};

/// The buffer that counters know by `name`, in the words of messages.
BufferPlan described_buffer(const std::string& name, double bytes);

/// Replaces `largest` by the buffer if that is larger.
void keep_larger(BufferPlan& largest, const BufferPlan& buffer);

/// The minimum of a grid: less than planned where a solid's parts may lie in each other.
struct MinGrid {
    double voxels = 0, made_bytes = 0, kept_bytes = 0;
};

/// One grid that is voxelized: a model's, or an object's in the world's lattice.
struct GridPlan {
    int model = 0;
    int object = -1;  ///< the object that alone shows it; -1: a model's, which objects share
    GridFrame frame;
    uint64_t triangles = 0;
    double voxels = 0;        ///< surface voxels
    double bricks = 0;        ///< stored
    double made_bytes = 0;    ///< device memory while it is made, its own included
    double kept_bytes = 0;    ///< device memory that it keeps until the world is formed
    MinGrid minimum = {};     ///< minimum of voxels, bricks and bytes
    BufferPlan largest = {};  ///< largest of the buffers that exist while it is made
};

/// The number of bricks of a lattice, stored or not.
double brick_table(const GridFrame& frame);

}  // namespace voxelume
