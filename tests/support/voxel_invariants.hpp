// SPDX-License-Identifier: Apache-2.0
// Invariants of every VoxelModel that a reader returns, whatever the file was.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "runtime/geometry/voxel_model.hpp"

namespace voxelume {

/// What is wrong with the model; empty if nothing is.
inline std::string broken_invariant(const VoxelModel& model) {
    const GridFrame& frame = model.frame;
    const glm::dvec3 numbers = frame.origin + frame.voxel_edge;
    if (!std::isfinite(numbers.x + numbers.y + numbers.z)) return "its place is no number";
    if (!(std::min({frame.voxel_edge.x, frame.voxel_edge.y, frame.voxel_edge.z}) > 0))
        return "its voxels have no size";
    if (model.slots.size() != bricks_of(frame)) return "its table isn't its frame's";
    const size_t stored = model.coordinates.size();
    if (stored == 0) return "it has no bricks";
    for (size_t slot = 0; slot < stored; ++slot) {
        const uint32_t brick = model.coordinates[slot];
        if (brick >= model.slots.size() || model.slots[brick] != slot)
            return "a brick isn't where its table says";
        if (slot > 0 && brick <= model.coordinates[slot - 1]) return "bricks aren't in order";
    }
    const auto is_stored = [](uint32_t slot) { return slot < kBrickInside; };
    if (size_t(std::ranges::count_if(model.slots, is_stored)) != stored)
        return "its table has bricks that aren't there";
    const bool smooth = model.surface == Surface::smooth;
    if (model.occupancy.size() != (smooth ? 0 : stored * kLeavesPerBrick))
        return "it has another number of leaves";
    if (model.distance.size() != (smooth ? stored * kVoxelsPerBrick : 0))
        return "it has another number of distances";
    if (!model.colors.empty() && model.colors.size() != stored * kVoxelsPerBrick)
        return "it has another number of colours";
    if (!model.color_codes.empty() && model.color_codes.size() != stored * kVoxelsPerBrick)
        return "it has another number of codes of colours";
    if (!smooth && model.voxels() == 0) return "it has no voxels";
    return {};
}

}  // namespace voxelume
