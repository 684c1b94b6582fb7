// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxels/voxel_limits.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/files/input_file.hpp"
#include "runtime/grid/grid.hpp"

namespace voxelume {

void check_voxel_span(const glm::dvec3& size, const InputFile& file) {
    const glm::dvec3 bricks = size / double(kBrickSize) + 1.0;
    if (!(std::max({size.x, size.y, size.z}) <= kMaxVoxelsPerAxis &&
          std::min({size.x, size.y, size.z}) >= 1 && bricks.x * bricks.y * bricks.z <= kMaxBricks))
        file.refuse(
            fmt::format("its voxels span {} x {} x {}, at most {} along each axis and {} "
                        "bricks of 16 in all are possible",
                        size.x, size.y, size.z, kMaxVoxelsPerAxis, kMaxBricks));
}

void check_listed_span(const glm::dvec3& size, const InputFile& file) {
    check_voxel_span(size, file);
    const glm::dvec3 bricks = size / double(kBrickSize) + 1.0;
    const double most = double(1 << 25) + 4096.0 * double(file.size());
    if (bricks.x * bricks.y * bricks.z > most)
        file.refuse(
            fmt::format("its voxels span {} x {} x {}, and {} bricks of 16 are possible in a file "
                        "of {} bytes",
                        size.x, size.y, size.z, most, file.size()));
}

void check_voxel_edge(const glm::dvec3& voxel_edge, const glm::dvec3& origin,
                      const InputFile& file) {
    for (int axis = 0; axis < 3; ++axis) {
        const double min_edge = std::max(1e-9, 1e-12 * std::abs(origin[axis]));
        if (!(voxel_edge[axis] >= min_edge))
            file.refuse(
                fmt::format("its voxels are {:.3g} m long, and at least {:.3g} m are possible "
                            "at its place",
                            voxel_edge[axis], min_edge));
    }
}

void check_reach(const GridFrame& frame, const InputFile& file) {
    constexpr double kMaxReach = 1e30;
    const glm::dvec3 end = frame.origin + frame.voxel_edge * glm::dvec3(frame.size);
    for (int axis = 0; axis < 3; ++axis) {
        const double reach = std::max(std::abs(frame.origin[axis]), std::abs(end[axis]));
        if (!(reach <= kMaxReach))
            file.refuse(
                fmt::format("its voxels lie {:.3g} m away, and at most {:.0e} m are possible",
                            reach, kMaxReach));
    }
}

void check_stored_bricks(size_t stored, const InputFile& file) {
    if (stored > kMaxStoredBricks)
        file.refuse(
            fmt::format("its voxels lie in {} bricks of 16 x 16 x 16, at most {} are possible",
                        stored, kMaxStoredBricks));
}

void check_listed_bricks(size_t stored, const InputFile& file) {
    const size_t most = std::min<uint64_t>(kMaxStoredBricks, (1 << 14) + 4 * file.size());
    if (stored > most)
        file.refuse(
            fmt::format("its voxels lie in more than {0} bricks of 16 x 16 x 16, and {0} are "
                        "possible in a file of {1} bytes",
                        most, file.size()));
}

}  // namespace voxelume
