// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/arrays/array_layout.hpp"

#include "kernels/shared/voxel.h"
#include "runtime/geometry/voxel_model.hpp"
#include "runtime/io/voxels/voxel_limits.hpp"

namespace voxelume {

CubeLayout layout_of(const CellArray& array, const InputFile& file) {
    CubeLayout layout;
    for (int axis = 0; axis < 3; ++axis) {
        AxisMap& map = layout.maps[size_t(array.axis[axis])];
        const int count = array.counts[array.axis[axis]];
        map.axis = axis;
        map.bricks = (count + kBrickSize - 1) / kBrickSize;
        map.is_mirrored = array.sign[axis] < 0;
        // A mirrored axis begins in the middle of a brick, where the file's cells end.
        const int room = map.is_mirrored ? (kBrickSize - count % kBrickSize) % kBrickSize : 0;
        const int before = room >= kModelMargin ? room : room + kBrickSize;
        map.first = map.is_mirrored ? (before + count) / kBrickSize - 1 : before / kBrickSize;
        map.step = map.is_mirrored ? -1 : 1;
        layout.frame.size[axis] = before + count + kModelMargin;
        layout.frame.origin[axis] = array.first_corner[axis] - before * array.voxel_edge[axis];
    }
    layout.frame.voxel_edge = array.voxel_edge;
    check_voxel_span(glm::dvec3(layout.frame.size), file);
    return layout;
}

std::vector<CellRun> runs_of(const std::vector<size_t>& bricks) {
    std::vector<CellRun> runs;
    for (size_t i = 0; i < bricks.size(); ++i) {
        if (i == 0 || bricks[i] != bricks[i - 1]) runs.push_back({int(i), int(i), bricks[i]});
        runs.back().end = int(i) + 1;
    }
    return runs;
}

}  // namespace voxelume
