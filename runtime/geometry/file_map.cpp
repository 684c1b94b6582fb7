// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/file_map.hpp"

#include <bit>
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

SurfaceArea scaled(const SurfaceArea& area, double scale) {
    const double factor = scale * scale;
    return {area.shadows * factor, area.total * factor, area.triangles, area.widths * scale,
            area.half_edges * scale};
}

/// The cells that some part of a surface lies in.
class CellBounds {
  public:
    explicit CellBounds(const glm::ivec3& size) : first_(size) {}

    void add(const glm::ivec3& cell) {
        first_ = glm::min(first_, cell);
        last_ = glm::max(last_, cell);
    }
    /// True if none of a cube of cells can change the bounds.
    bool hold(const glm::ivec3& corner, int size) const {
        return glm::min(first_, corner) == first_ && glm::max(last_, corner + size - 1) == last_;
    }
    glm::ivec3 first() const { return last_.x < 0 ? glm::ivec3(0) : first_; }
    glm::ivec3 last() const { return glm::max(last_, 0); }

  private:
    glm::ivec3 first_, last_{-1};
};

void add_occupied(const uint64_t* leaves, const glm::ivec3& corner, CellBounds& bounds) {
    for (size_t leaf = 0; leaf < kLeavesPerBrick; ++leaf) {
        const glm::ivec3 start = corner + leaf_corner(leaf);
        if (leaves[leaf] == 0 || bounds.hold(start, kLeafSize)) continue;
        for (uint64_t mask = leaves[leaf]; mask != 0; mask &= mask - 1)
            bounds.add(start + cell_in_leaf(std::countr_zero(mask)));
    }
}

void add_surface(const int16_t* distances, const glm::ivec3& corner, CellBounds& bounds) {
    for (size_t i = 0; i < kVoxelsPerBrick; ++i)
        if (std::abs(distances[i]) < kDistanceUnitsPerVoxel) bounds.add(corner + cell_in_brick(i));
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
    result.area = scaled(summary.area, map.scale);
    result.min_area = scaled(summary.min_area, map.scale);
    result.topology.hole_area *= map.scale * map.scale;
    result.topology.volume *= map.scale * map.scale * map.scale;
    return result;
}

Bounds occupied_bounds(const VoxelModel& voxels) {
    if (!voxels.mesh.triangles.empty()) return mesh_bounds(voxels.mesh);
    CellBounds bounds(voxels.frame.size);
    for (size_t slot = 0; slot < voxels.coordinates.size(); ++slot) {
        const glm::ivec3 corner = brick_corner(voxels.frame, voxels.coordinates[slot]);
        if (bounds.hold(corner, kBrickSize)) continue;
        if (voxels.distance.empty())
            add_occupied(voxels.occupancy.data() + slot * kLeavesPerBrick, corner, bounds);
        else
            add_surface(voxels.distance.data() + slot * kVoxelsPerBrick, corner, bounds);
    }
    const GridFrame& frame = voxels.frame;
    return {frame.origin + glm::dvec3(bounds.first()) * frame.voxel_edge,
            frame.origin + glm::dvec3(bounds.last() + 1) * frame.voxel_edge};
}

}  // namespace voxelume
