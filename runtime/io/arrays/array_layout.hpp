// SPDX-License-Identifier: Apache-2.0
// Where the cells of an array lie in a model.
#pragma once

#include <array>
#include <vector>

#include "runtime/grid/grid_frame.hpp"
#include "runtime/io/arrays/cell_array.hpp"

namespace voxelume {

/// A cell's place along one axis of the model, by its number along the file's axis.
struct AxisMap {
    int axis = 0;    ///< of the model
    int bricks = 0;  ///< of the file's cells, 16 each
    int first = 0;   ///< the brick of the model in which cells 0..15 lie
    int step = 1;    ///< from brick to brick
    bool is_mirrored = false;
};

/// Lays the model's lattice so that 16 cells of the file are one brick along each axis.
struct CubeLayout {
    GridFrame frame;
    std::array<AxisMap, 3> maps;  ///< by the file's axes
};

CubeLayout layout_of(const CellArray& array, const InputFile& file);

/// Cells in a row that lie in one brick, to whose number they add.
struct CellRun {
    int first, end;
    size_t brick;
};

/// The runs of cells that add the same to the number of their brick; `bricks` has what each cell
/// adds.
std::vector<CellRun> runs_of(const std::vector<size_t>& bricks);

}  // namespace voxelume
