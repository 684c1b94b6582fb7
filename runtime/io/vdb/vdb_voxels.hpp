// SPDX-License-Identifier: Apache-2.0
// OpenVDB -> the voxels of a model.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/scene/parts/surface.hpp"

namespace voxelume {

/// A value that successive cells along +x have.
struct ValueRun {
    float value;
    int cells;  ///< at least 1
};

/// The active voxels of one grid.
struct VdbVoxels {
    using Runs = std::function<ValueRun(const glm::ivec3&)>;

    std::vector<glm::ivec3> cells;
    std::vector<float> values;
    std::vector<glm::vec3> colors;  ///< linear colours of grid `Cd`; empty without it
    glm::dvec3 voxel_edges{1.0};    ///< metres
    glm::dvec3 origin{0.0};         ///< position of the value of cell (0, 0, 0), metres
    /// The value of any cell, active or not, and how many cells from it on have it; for level sets
    /// alone. A copy caches nodes, so each thread needs its own.
    Runs run_at;
};

/// The maximum number of active voxels of a model.
inline constexpr uint64_t kMaxVdbVoxels = uint64_t{1} << 26;

/// Reads, for cubes, the float grid `density`, or the first that isn't a level set; for smooth
/// surfaces, the first level set.
///
/// Throws Error::input for a file that is missing, damaged, too large, without such a grid, or
/// whose grid is turned or sheared by its transform.
VdbVoxels read_vdb_voxels(const std::filesystem::path& path, Surface surface);

}  // namespace voxelume
