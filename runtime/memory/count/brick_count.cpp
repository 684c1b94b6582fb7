// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/brick_count.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "runtime/geometry/solid/solid_parts.hpp"

namespace voxelume {
namespace {

constexpr double kMaxMarked = 1 << 28;   ///< bricks of a lattice that are told apart
constexpr double kMaxCounted = 1 << 17;  ///< bricks of a surface: some hundredths of a second
constexpr size_t kSampledBricks = 256;   ///< bricks whose leaves of 4³ voxels are counted
constexpr size_t kSampledLeaves = 512;   ///< leaves of these whose voxels are counted

/// The maximum distance of a surface from a voxel that still counts as in it, in edges: 0.18 along
/// the axes, and 0 at corners, where solids are voxelized.
constexpr double kCover = 0.1;

constexpr double kLeafEdge = 5.5;  ///< voxels: boxes that aren't divided further

/// A box in a lattice's voxels.
struct Cell {
    glm::dvec3 low, high;

    glm::dvec3 middle() const { return 0.5 * (low + high); }
    glm::dvec3 half() const { return 0.5 * (high - low); }
    Cell part(int number) const {
        const glm::dvec3 m = middle();
        Cell cell = *this;
        for (int axis = 0; axis < 3; ++axis)
            (number >> axis & 1 ? cell.low : cell.high)[axis] = m[axis];
        return cell;
    }
};

class BrickCounter {
  public:
    /// With `parts`, a voxel is counted once for each part whose surface crosses it.
    BrickCounter(const SolidField& field, const GridFrame& frame, const BrickRule& rule,
                 TakenBricks& taken, std::span<const SolidField> parts = {})
        : field_(field), frame_(frame), rule_(rule), taken_(taken), parts_(parts) {
        const glm::dvec3& e = frame.voxel_edge;
        reach_ = rule.reach * std::min({e.x, e.y, e.z});
    }

    BrickCount count(const VoxelBox& box) {
        const glm::dvec3 edge(kBrickSize);
        const glm::ivec3 last = frame_.bricks() - 1;
        first_ = glm::ivec3(
            glm::clamp(glm::floor(box.low / edge) - 1.0, glm::dvec3(0), glm::dvec3(last)));
        last_ = glm::ivec3(
            glm::clamp(glm::floor(box.high / edge) + 1.0, glm::dvec3(0), glm::dvec3(last)));
        const glm::ivec3 size = last_ - first_ + 1;
        int span = 1;
        while (span < std::max({size.x, size.y, size.z})) span *= 2;
        visit(first_, span);
        return {{voxels(), bricks_}, new_bricks_};
    }

  private:
    /// The distance at a voxel. Parts beyond the lattice's ends are cut off if the rule says so.
    double distance(const glm::dvec3& voxel) const {
        const double d = field_.distance(frame_.origin + frame_.voxel_edge * voxel);
        if (!rule_.closes_ends) return d;
        const glm::dvec3 beyond =
            glm::max(-voxel, voxel - glm::dvec3(frame_.size)) * frame_.voxel_edge;
        return std::max({d, beyond.x, beyond.y, beyond.z});
    }
    double radius(const Cell& cell) const { return glm::length(cell.half() * frame_.voxel_edge); }

    void visit(const glm::ivec3& brick, int span) {
        if (glm::any(glm::greaterThan(brick, last_))) return;
        const glm::dvec3 corner(brick * kBrickSize);
        const Cell cell{corner + rule_.first,
                        corner + double((span - 1) * kBrickSize) + rule_.last};
        const double d = distance(cell.middle());
        if (std::abs(d) > radius(cell) + reach_) {
            if (d < 0 && rule_.keeps_inside) keep_inside(brick, span);
            return;
        }
        if (span == 1) {
            if (is_near(cell, d)) {
                stored_.push_back(brick);
                take(brick);
            } else if (d < 0 && rule_.keeps_inside) {
                keep_inside(brick, 1);
            }
            return;
        }
        for (int part = 0; part < 8; ++part)
            visit(brick + span / 2 * glm::ivec3(part & 1, part >> 1 & 1, part >> 2), span / 2);
    }

    /// True if the surface may be near the cell. `d` is the distance at its middle.
    bool is_near(const Cell& cell, double d) const {
        if (std::abs(d) <= reach_) return true;
        const glm::dvec3 half = cell.half();
        if (std::max({half.x, half.y, half.z}) < kLeafEdge / 2) return false;
        for (int number = 0; number < 8; ++number) {
            const Cell part = cell.part(number);
            const double of_part = distance(part.middle());
            if (std::abs(of_part) <= radius(part) + reach_ && is_near(part, of_part)) return true;
        }
        return false;
    }

    void keep_inside(const glm::ivec3& brick, int span) {
        const glm::ivec3 end = glm::min(brick + span - 1, last_);
        for (int z = brick.z; z <= end.z; ++z)
            for (int y = brick.y; y <= end.y; ++y)
                for (int x = brick.x; x <= end.x; ++x) {
                    take({x, y, z});
                    inside_voxels_ += kVoxelsPerBrick;
                }
    }

    void take(const glm::ivec3& brick) {
        ++bricks_;
        new_bricks_ += taken_.take(brick) ? 1 : 0;
    }

    /// The sample of number `i` of `samples` among `count`. Equal steps might take the same corner
    /// of each block; multiples of the golden ratio don't.
    static size_t nth(size_t i, size_t samples, size_t count) {
        if (count <= samples) return i;
        const double turns = double(i) * 0.6180339887498949;
        return std::min(size_t((turns - std::floor(turns)) * double(count)), count - 1);
    }

    /// The number of voxels, extrapolated from some bricks and some of their leaves, evenly spread.
    double voxels() const {
        if (stored_.empty()) return inside_voxels_;
        const size_t bricks = std::min(stored_.size(), kSampledBricks);
        std::vector<Cell> near;
        double inside = 0;
        for (size_t i = 0; i < bricks; ++i) {
            const glm::dvec3 corner(stored_[nth(i, bricks, stored_.size())] * kBrickSize);
            inside += find_leaves({corner, corner + double(kBrickSize)}, near);
        }
        const size_t leaves = std::min(near.size(), kSampledLeaves);
        double sum = 0;
        for (size_t i = 0; i < leaves; ++i)
            sum += voxels_of_leaf(near[nth(i, leaves, near.size())]);
        if (leaves > 0) sum *= double(near.size()) / double(leaves);
        return inside_voxels_ + (inside + sum) * double(stored_.size()) / double(bricks);
    }

    bool is_filled() const { return rule_.keeps_inside || rule_.fills; }

    /// Appends the leaves that the surface may pass through. Returns the number of voxels in other
    /// leaves.
    double find_leaves(const Cell& cell, std::vector<Cell>& near) const {
        const double d = distance(cell.middle()), size = cell.high.x - cell.low.x;
        if (std::abs(d) > radius(cell)) return is_filled() && d < 0 ? size * size * size : 0;
        if (size <= kLeafSize) {
            if (!glm::any(glm::greaterThan(cell.middle(), glm::dvec3(frame_.size))))
                near.push_back(cell);
            return 0;
        }
        double sum = 0;
        for (int part = 0; part < 8; ++part) sum += find_leaves(cell.part(part), near);
        return sum;
    }

    /// The number of voxels whose corners lie on both sides of the surface, or on it; in filled
    /// sets, also of those with a corner inside.
    double voxels_of_leaf(const Cell& leaf) const {
        constexpr int kNodes = kLeafSize + 1;
        const double zero = rule_.cover * frame_.voxel_edge.x;
        std::array<bool, size_t(kNodes) * kNodes * kNodes> inside, outside;
        for (int i = 0; i < kNodes * kNodes * kNodes; ++i) {
            const glm::ivec3 node(i % kNodes, i / kNodes % kNodes, i / (kNodes * kNodes));
            const double d = distance(leaf.low + glm::dvec3(node));
            inside[size_t(i)] = d <= zero;
            outside[size_t(i)] = d >= -zero;
        }
        double count = 0;
        for (int i = 0; i < kLeafSize * kLeafSize * kLeafSize; ++i) {
            const glm::ivec3 voxel(i % kLeafSize, i / kLeafSize % kLeafSize,
                                   i / (kLeafSize * kLeafSize));
            bool has_inside = false, has_outside = is_filled();
            for (int corner = 0; corner < 8; ++corner) {
                const glm::ivec3 node =
                    voxel + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
                const int at = node.x + kNodes * (node.y + kNodes * node.z);
                has_inside |= inside[size_t(at)];
                has_outside |= outside[size_t(at)];
            }
            if (has_inside && has_outside) count += fields_in(leaf.low + glm::dvec3(voxel) + 0.5);
        }
        return count;
    }

    /// The number of parts whose surfaces are in the voxel around a point, estimated by their
    /// distance from its middle.
    double fields_in(const glm::dvec3& middle) const {
        constexpr double kReach = 0.7;  // edges
        const glm::dvec3 p = frame_.origin + frame_.voxel_edge * middle;
        double count = 0;
        for (const SolidField& part : parts_)
            count += std::abs(part.distance(p)) < kReach * frame_.voxel_edge.x ? 1 : 0;
        return std::max(count, 1.0);
    }

    const SolidField& field_;
    const GridFrame& frame_;
    BrickRule rule_;
    TakenBricks& taken_;
    std::span<const SolidField> parts_;
    double reach_;  ///< metres
    glm::ivec3 first_{0}, last_{0};
    std::vector<glm::ivec3> stored_;  ///< with surface
    double bricks_ = 0, new_bricks_ = 0, inside_voxels_ = 0;
};

/// The maximum number of bricks that the surface of a box passes through.
double max_bricks(const VoxelBox& box) {
    const glm::dvec3 size = glm::max(box.high - box.low, 0.0) / double(kBrickSize) + 2.0;
    return 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
}

}  // namespace

bool TakenBricks::take(const glm::ivec3& brick) {
    const double count = double(table_.x) * table_.y * table_.z;
    if (count > kMaxMarked) return true;
    if (taken_.empty()) taken_.resize(size_t(count));
    auto is_taken =
        taken_[size_t(brick.x) +
               size_t(table_.x) * (size_t(brick.y) + size_t(table_.y) * size_t(brick.z))];
    const bool is_new = !is_taken;
    is_taken = true;
    return is_new;
}

BrickRule model_rule(Surface surface, bool is_solid_set) {
    // Distances are stored around blocks of 4³ nodes, voxels around blocks of 4³ voxels.
    if (stores_distances(surface)) return {.first = 0, .last = 15, .reach = 2.8 + 2.6};
    return {.first = 0,
            .last = 16,
            .reach = 3.46,
            .fills = is_solid_set,
            .closes_ends = is_solid_set,
            .cover = kCover};
}

BrickRule world_rule(Surface surface, bool is_solid_set, bool keeps_inside, double spread) {
    // A voxel more on each side, and leaves of the object that overlap it.
    const double half = 9 * spread + 1.5;
    BrickRule rule{8 - half, 8 + half, 3.6, keeps_inside, is_solid_set, true};
    if (stores_distances(surface)) rule.reach = 2.9 + 2.4;
    if (lists_primitives(surface)) rule.cover = kCover;
    return rule;
}

BrickCount count_bricks(const SolidField& field, const GridFrame& frame, const VoxelBox& box,
                        const BrickRule& rule, TakenBricks& taken,
                        std::span<const SolidField> parts) {
    if (glm::any(glm::greaterThan(box.low, box.high))) return {};
    if (max_bricks(box) <= kMaxCounted)
        return BrickCounter(field, frame, rule, taken, parts).count(box);
    GridFrame coarse = frame;
    coarse.voxel_edge *= 2;
    coarse.size = (frame.size + 1) / 2;
    TakenBricks apart(coarse);
    const SurfaceExtent quarter =
        count_bricks(field, coarse, {0.5 * box.low, 0.5 * box.high}, rule, apart, parts).extent;
    return {{4 * quarter.voxels, 4 * quarter.bricks}, 4 * quarter.bricks};
}

BrickCount count_parts(const Solid& solid, const glm::dmat4& frame_from_solid,
                       const GridFrame& frame, const VoxelBox& box, const BrickRule& rule,
                       TakenBricks& taken) {
    // The outside of a part is closed where the box around the solid ends.
    constexpr double kComplementMargin = 1.25;
    const std::vector<SolidPart> divided = parts_of(solid);
    std::vector<SolidField> parts;
    parts.reserve(divided.size());
    for (const SolidPart& part : divided) parts.emplace_back(part.solid, frame_from_solid);
    const SolidField whole(solid, frame_from_solid);
    if (parts.size() == 1) return count_bricks(whole, frame, box, rule, taken);
    BrickCount count = count_bricks(whole, frame, box, rule, taken, parts);
    double bricks = 0;
    for (size_t i = 0; i < parts.size(); ++i) {
        TakenBricks own(frame);
        bricks += (divided[i].is_complement ? kComplementMargin : 1) *
                  count_bricks(parts[i], frame, box, rule, own).extent.bricks;
    }
    count.extent.bricks = std::max(bricks, count.extent.bricks);
    return count;
}

}  // namespace voxelume
