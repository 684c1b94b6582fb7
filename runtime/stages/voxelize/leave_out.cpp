// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/voxelize/leave_out.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <vector>

#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/stages/voxelize/mesh_lattice.hpp"

namespace voxelume {
namespace {

/// The increase of distances at 0, 1, 2 .. nodes from the nearest point, in distance units: 1.5
/// voxels, at which walls thinner than two disappear, and beyond the walls less from node to node.
/// The interpolated field bulges outwards next to a rise, by up to a sixteenth of it; since each
/// rise is a fifth of the one before, the surface still sinks.
constexpr std::array<int, kLeftOut + 1> kRise = {12288, 12288, 12288, 2458, 492, 98};

/// The maximum ratio of the field's voxels to `voxel_edge`.
constexpr double kLargest = 4.0 / 3;

/// The distances of a grid in main memory, and which nodes are near points.
class Nodes {
  public:
    explicit Nodes(const BrickGrid& grid)
        : size_(grid.frame.size),
          bricks_(grid.frame.bricks()),
          slots_(grid.slots.read()),
          distances_(grid.distance.read()),
          is_near_(distances_.size()) {}

    /// Raises a node that no earlier call has raised. Returns whether it did.
    bool raise(const glm::ivec3& node, int rise) {
        if (glm::any(glm::lessThan(node, glm::ivec3(0))) ||
            glm::any(glm::greaterThanEqual(node, size_)))
            return false;
        const glm::ivec3 brick = node / kBrickSize, in = node % kBrickSize;
        const uint32_t slot =
            slots_[size_t(brick.x) +
                   size_t(bricks_.x) * (size_t(brick.y) + size_t(bricks_.y) * size_t(brick.z))];
        if (slot >= kBrickInside) return false;
        const size_t index =
            slot * kVoxelsPerBrick + size_t(in.x + kBrickSize * (in.y + kBrickSize * in.z));
        if (is_near_[index]) return false;
        is_near_[index] = true;
        distances_[index] = int16_t(std::min(distances_[index] + rise, 32767));
        return true;
    }

    const std::vector<int16_t>& distances() const { return distances_; }

  private:
    glm::ivec3 size_, bricks_;
    std::vector<uint32_t> slots_;
    std::vector<int16_t> distances_;
    std::vector<bool> is_near_;
};

/// Raises the nodes around `from` that no earlier call has raised, and returns them.
std::vector<glm::ivec3> raise_around(const std::vector<glm::ivec3>& from, int rise, Nodes& nodes) {
    std::vector<glm::ivec3> raised;
    for (const glm::ivec3& node : from)
        for (int i = 0; i < 27; ++i) {
            const glm::ivec3 neighbour = node + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1;
            if (nodes.raise(neighbour, rise)) raised.push_back(neighbour);
        }
    return raised;
}

}  // namespace

void leave_out(std::span<const glm::vec3> points, double voxel_edge,
               const glm::dmat4& frame_from_mesh, BrickGrid& field) {
    const glm::dvec3& edge = field.frame.voxel_edge;
    const double own =
        std::max({edge.x, edge.y, edge.z}) / stretch_of(glm::dmat3(frame_from_mesh)).min;
    if (field.brick_count == 0 || points.empty() || own > kLargest * voxel_edge) return;
    Nodes nodes(field);
    std::vector<glm::ivec3> reached;
    for (const glm::vec3& p : points) {
        const glm::ivec3 node(glm::round(to_voxels(p, frame_from_mesh, field.frame)));
        if (nodes.raise(node, kRise[0])) reached.push_back(node);
    }
    for (int i = 1; i <= kLeftOut; ++i) reached = raise_around(reached, kRise[size_t(i)], nodes);
    field.distance.write(nodes.distances());
}

}  // namespace voxelume
