// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/voxelize/leave_out.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <vector>

#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/stages/voxelize/mesh_lattice.hpp"

namespace voxelume {
namespace {

constexpr int16_t kOutside = 32767;

/// How many times as large the field's voxels may be.
constexpr double kLargest = 4.0 / 3;

/// The distances of a grid, in main memory.
class Nodes {
  public:
    explicit Nodes(const BrickGrid& grid)
        : size_(grid.frame.size),
          bricks_(grid.frame.bricks()),
          slots_(grid.slots.read()),
          distances_(grid.distance.read()) {}

    void leave_out(const glm::ivec3& node) {
        const glm::ivec3 low = glm::max(node - kLeftOut, 0);
        const glm::ivec3 high = glm::min(node + kLeftOut, size_ - 1);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x) set({x, y, z});
    }

    const std::vector<int16_t>& distances() const { return distances_; }

  private:
    void set(const glm::ivec3& node) {
        const glm::ivec3 brick = node / kBrickSize, in = node % kBrickSize;
        const uint32_t slot =
            slots_[size_t(brick.x) +
                   size_t(bricks_.x) * (size_t(brick.y) + size_t(bricks_.y) * size_t(brick.z))];
        if (slot >= kBrickInside) return;
        distances_[slot * kVoxelsPerBrick +
                   size_t(in.x + kBrickSize * (in.y + kBrickSize * in.z))] = kOutside;
    }

    glm::ivec3 size_, bricks_;
    std::vector<uint32_t> slots_;
    std::vector<int16_t> distances_;
};

}  // namespace

void leave_out(std::span<const glm::vec3> points, double voxel_edge,
               const glm::dmat4& frame_from_mesh, BrickGrid& field) {
    const glm::dvec3& edge = field.frame.voxel_edge;
    const double own =
        std::max({edge.x, edge.y, edge.z}) / stretch_of(glm::dmat3(frame_from_mesh)).min;
    if (field.brick_count == 0 || points.empty() || own > kLargest * voxel_edge) return;
    std::vector<std::array<int, 3>> nearest;
    for (const glm::vec3& p : points) {
        const glm::ivec3 node(glm::round(to_voxels(p, frame_from_mesh, field.frame)));
        nearest.push_back({node.x, node.y, node.z});
    }
    std::ranges::sort(nearest);
    nearest.erase(std::unique(nearest.begin(), nearest.end()), nearest.end());
    Nodes nodes(field);
    for (const auto& [x, y, z] : nearest) nodes.leave_out({x, y, z});
    field.distance.write(nodes.distances());
}

}  // namespace voxelume
