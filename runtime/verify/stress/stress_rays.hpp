// SPDX-License-Identifier: Apache-2.0
// rays of a class -> mismatches between the device's walk and the exact one.
#pragma once

#include "runtime/verify/stress/ray_classes.hpp"
#include "runtime/verify/stress/stress.hpp"

namespace voxelume {

/// The number of consecutive rays that share one grid and one kind of comparison.
inline constexpr uint64_t kRaysOfOneGrid = 1u << 14;

/// The number of grids. After the last one the first follows again.
inline constexpr uint64_t kRayGrids = 15;

/// The compared result of a ray.
enum class Compared {
    cells,      ///< all cells, one by one
    blocks,     ///< the cells entered out of blocks of 1 to 64 cells
    first_hit,  ///< the hit that trace.cl finds among scattered voxels
};

/// The grid that ray `number` passes through, and the result that is compared.
struct RayGrid {
    glm::ivec3 size;
    Compared compared;
    uint32_t max_cells;  ///< maximum number of a walk's cells that are compared; 0: all
};
RayGrid grid_of_ray(uint64_t number);

/// Tries rays of one class.
StressResult stress_rays(RayClass kind, const StressRun& run);

/// A ray's numbers and the grid's, as `voxelume stress` prints them for a mismatch.
std::string describe(const FixedGrid& grid, const FixedRay& ray);

}  // namespace voxelume
