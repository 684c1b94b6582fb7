// rays of a class -> mismatches between the device's walk and the exact one.
#pragma once

#include "runtime/verify/stress/ray_classes.hpp"
#include "runtime/verify/stress/stress.hpp"

namespace voxelume {

/// Rays in a row that have one grid and one way of being compared.
inline constexpr uint64_t kRaysOfOneGrid = 1u << 14;

/// After as many grids the first comes again.
inline constexpr uint64_t kRayGrids = 15;

/// What is compared of a ray.
enum class Compared {
    cells,      ///< all cells, one by one
    blocks,     ///< the cells entered out of blocks of 1 to 64 cells
    first_hit,  ///< the hit that trace.cl finds among scattered voxels
};

/// The grid that ray `number` goes through, and what is compared there.
struct RayGrid {
    glm::ivec3 size;
    Compared compared;
    uint32_t max_cells;  ///< of a walk that are compared; 0: all
};
RayGrid grid_of_ray(uint64_t number);

/// Tries rays of one class.
StressResult stress_rays(RayClass kind, const StressRun& run);

/// A ray's numbers, and the grid's: what `voxelume stress` prints of a mismatch.
std::string describe(const FixedGrid& grid, const FixedRay& ray);

}  // namespace voxelume
