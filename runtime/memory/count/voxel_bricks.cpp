// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/voxel_bricks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "runtime/grid/brick_cells.hpp"

namespace voxelume {
namespace {

/// Counts the bricks that placing stores for leaves of a file, each once.
class LeafCounter {
  public:
    LeafCounter(const GridFrame& file, const glm::dmat4& world_from_object, double spread,
                const GridFrame& world)
        : last_(world.bricks() - 1) {
        const glm::dvec3 origin(world_from_object * glm::dvec4(file.origin, 1));
        origin_ = (origin - world.origin) / world.voxel_edge;
        // A brick is stored with a voxel around it; both together decide.
        constexpr double kHalf = kBrickSize / 2.0 + 1;
        reach_ = glm::dvec3(kHalf * spread - kBrickSize / 2.0);
        for (int axis = 0; axis < 3; ++axis) {
            axes_[axis] =
                glm::dvec3(world_from_object[axis]) * file.voxel_edge[axis] / world.voxel_edge;
            reach_ += glm::abs(axes_[axis]) * (0.5 * kLeafSize);
        }
    }

    /// `first` is the minimum corner of the leaf in the file's voxels.
    void add_leaf(const glm::ivec3& first) {
        const glm::dvec3 middle = origin_ + axes_ * (glm::dvec3(first) + 0.5 * kLeafSize);
        const glm::dvec3 low = glm::floor((middle - reach_) / double(kBrickSize));
        const glm::dvec3 high = glm::floor((middle + reach_) / double(kBrickSize));
        const glm::ivec3 begin(glm::clamp(low, glm::dvec3(0), glm::dvec3(last_) + 1.0));
        const glm::ivec3 end(glm::clamp(high, glm::dvec3(-1), glm::dvec3(last_)));
        for (int z = begin.z; z <= end.z; ++z)
            for (int y = begin.y; y <= end.y; ++y)
                for (int x = begin.x; x <= end.x; ++x) bricks_.push_back({z, y, x});
        if (bricks_.size() > max_waiting_) shrink();
    }

    BrickCount count(TakenBricks& taken) {
        shrink();
        BrickCount found;
        found.extent.bricks = double(bricks_.size());
        for (const auto& [z, y, x] : bricks_) found.new_bricks += taken.take({x, y, z}) ? 1 : 0;
        return found;
    }

  private:
    void shrink() {
        std::sort(bricks_.begin(), bricks_.end());
        bricks_.erase(std::unique(bricks_.begin(), bricks_.end()), bricks_.end());
        max_waiting_ = std::max(max_waiting_, 2 * bricks_.size());
    }

    glm::ivec3 last_;
    glm::dvec3 origin_, reach_;  ///< in the world's voxels
    glm::dmat3 axes_{1};         ///< axes of the file's voxels
    std::vector<std::array<int, 3>> bricks_;
    size_t max_waiting_ = 1 << 16;
};

/// The volume of one of the file's voxels in voxels of the world.
double size_in(const GridFrame& world, const GridFrame& file, const glm::dmat4& world_from_object) {
    const auto volume = [](const glm::dvec3& edge) { return edge.x * edge.y * edge.z; };
    return volume(file.voxel_edge) / volume(world.voxel_edge) *
           std::abs(glm::determinant(world_from_object));
}

BrickCount count_leaves(const VoxelModel& cubes, LeafCounter& counter, TakenBricks& taken) {
    for (size_t slot = 0; slot < cubes.coordinates.size(); ++slot) {
        const glm::ivec3 corner = brick_corner(cubes.frame, cubes.coordinates[slot]);
        for (size_t leaf = 0; leaf < kLeavesPerBrick; ++leaf)
            if (cubes.occupancy[slot * kLeavesPerBrick + leaf] != 0)
                counter.add_leaf(corner + leaf_corner(leaf));
    }
    return counter.count(taken);
}

}  // namespace

BrickCount count_voxels(const VoxelModel& voxels, const glm::dmat4& world_from_object,
                        double spread, const GridFrame& world, TakenBricks& taken) {
    const double more = std::max(1.0, size_in(world, voxels.frame, world_from_object));
    const double bricks = 1.4 * double(voxels.coordinates.size()) * more;
    BrickCount found{{0, bricks}, bricks};
    // If leaves are as large as many bricks, the list would be longer than the world's.
    constexpr double kMaxVoxels = 64;
    if (!voxels.occupancy.empty() && more <= kMaxVoxels) {
        LeafCounter counter(voxels.frame, world_from_object, spread, world);
        found = count_leaves(voxels, counter, taken);
    }
    found.extent.voxels = double(voxels.voxels()) * more;
    return found;
}

SurfaceExtent min_count(const VoxelModel& voxels, const glm::dmat4& world_from_object,
                        const GridFrame& world) {
    const double less = std::min(1.0, size_in(world, voxels.frame, world_from_object));
    return {double(voxels.voxels()) * less, double(voxels.coordinates.size()) * less};
}

}  // namespace voxelume
