// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/file_map.hpp"

#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>

#include "runtime/base/error.hpp"
#include "runtime/grid/brick_cells.hpp"

namespace voxelume {
namespace {

glm::vec3 nearest_float(const FileMap& map, const glm::dvec3& p) {
    return glm::vec3(map(p));
}

Bounds rounded(const FileMap& map, const Bounds& box) {
    return {glm::dvec3(nearest_float(map, box.min)), glm::dvec3(nearest_float(map, box.max))};
}

SurfaceArea scaled(const SurfaceArea& area, double factor) {
    return {area.shadows * factor, area.total * factor};
}

/// Whether voxel `i` of the stored bricks has a part of the surface.
bool is_shown(const VoxelModel& voxels, size_t slot, const glm::ivec3& cell, size_t i) {
    if (!voxels.distance.empty()) return std::abs(voxels.distance[i]) < kDistanceUnitsPerVoxel;
    const uint64_t mask = voxels.occupancy[slot * kLeavesPerBrick + leaf_in_brick(cell)];
    return (mask & bit_in_leaf(cell)) != 0;
}

}  // namespace

void apply(const FileMap& map, const std::filesystem::path& file, Mesh& mesh) {
    for (glm::vec3& position : mesh.positions) {
        position = nearest_float(map, glm::dvec3(position));
        if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z))
            throw Error(ErrorKind::input,
                        "{}: in metres a coordinate is too large for a number; choose another unit",
                        file.string());
    }
}

void apply(const FileMap& map, const std::filesystem::path& file, VoxelModel& voxels) {
    voxels.frame.origin = map(voxels.frame.origin);
    voxels.frame.voxel_edge *= map.scale;
    apply(map, file, voxels.mesh);
}

MeshSummary mapped(const FileMap& map, const MeshSummary& summary) {
    MeshSummary result = summary;
    result.surface = rounded(map, summary.surface);
    result.vertices = rounded(map, summary.vertices);
    result.area = scaled(summary.area, map.scale * map.scale);
    result.min_area = scaled(summary.min_area, map.scale * map.scale);
    result.topology.hole_area *= map.scale * map.scale;
    result.topology.volume *= map.scale * map.scale * map.scale;
    return result;
}

Bounds occupied_bounds(const VoxelModel& voxels) {
    if (!voxels.mesh.triangles.empty()) return mesh_bounds(voxels.mesh);
    glm::ivec3 first = voxels.frame.size, last(-1);
    for (size_t slot = 0; slot < voxels.coordinates.size(); ++slot) {
        const glm::ivec3 start = brick_corner(voxels.frame, voxels.coordinates[slot]);
        for (size_t i = 0; i < kVoxelsPerBrick; ++i) {
            const glm::ivec3 cell = cell_in_brick(i);
            if (!is_shown(voxels, slot, cell, slot * kVoxelsPerBrick + i)) continue;
            first = glm::min(first, start + cell);
            last = glm::max(last, start + cell);
        }
    }
    if (last.x < 0) first = last = glm::ivec3(0);
    const GridFrame& frame = voxels.frame;
    return {frame.origin + glm::dvec3(first) * frame.voxel_edge,
            frame.origin + glm::dvec3(last + 1) * frame.voxel_edge};
}

}  // namespace voxelume
