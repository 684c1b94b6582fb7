// SPDX-License-Identifier: Apache-2.0
// Where the cells of an array lie in a model.
#pragma once

#include <array>
#include <vector>

#include "runtime/grid/grid_frame.hpp"
#include "runtime/io/arrays/cell_array.hpp"

namespace voxelume {

/// The map from a cell's number along the file's axis to its position along an axis of the model.
struct AxisMap {
    int axis = 0;    ///< axis of the model
    int bricks = 0;  ///< number of bricks of 16 cells of the file
    int first = 0;   ///< the brick of the model in which cells 0..15 lie
    int step = 1;    ///< step in the model from one brick of the file to the next
    bool is_mirrored = false;
};

/// Lays the model's lattice so that 16 cells of the file are one brick along each axis.
struct CubeLayout {
    GridFrame frame;
    std::array<AxisMap, 3> maps;  ///< by the file's axes
};

CubeLayout layout_of(const CellArray& array, const InputFile& file);

/// Consecutive cells that lie in one brick, and the part that they add to the brick's number.
struct CellRun {
    int first, end;
    size_t brick;
};

/// The runs of cells that lie in one brick; `bricks` has the part that each cell adds to the number
/// of its brick.
std::vector<CellRun> runs_of(const std::vector<size_t>& bricks);

}  // namespace voxelume
