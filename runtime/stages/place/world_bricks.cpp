// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/place/world_bricks.hpp"

#include <algorithm>
#include <utility>

#include "kernels/shared/normal.h"
#include "runtime/stages/brick_arrays.hpp"
#include "runtime/stages/place/place_painter.hpp"

namespace voxelume {
namespace {

constexpr uint8_t kFull = 1, kSurface = 2;  // lib/voxelize/placed.h
constexpr size_t kVoxels = 4096;            // in a brick
constexpr int16_t kSaturated = 32767;       // the distance far from any surface
constexpr uint32_t kWhite = 0xFFFFFF;       // the colour of voxels without one of their own

constexpr const char* kOccupancy = "world occupancy";
constexpr const char* kDistances = "world distances";
constexpr const char* kAttributes = "world attributes";
constexpr const char* kColors = "world colors";
constexpr const char* kNormals = "world voxel normals";

/// Replaces an `old` buffer by a larger one that begins with its values.
template <class T>
void enlarge(Buffer<T>& old, Buffer<T> larger) {
    larger.copy(old);
    old = std::move(larger);
}

}  // namespace

Defines brick_defines(const WorldParts& parts) {
    return {{"VXL_SMOOTH", parts.smooth},
            {"VXL_OCCUPANCY", parts.occupancy},
            {"VXL_ATTRIBUTES", parts.has_attributes()},
            {"VXL_COLORS", parts.colors},
            {"VXL_VOXEL_NORMALS", parts.normals}};
}

WorldBricks::WorldBricks(const Device& device, const WorldParts& parts, BrickGrid& world)
    : device_(device),
      smooth_(parts.smooth),
      occupancy_(parts.occupancy),
      has_attributes_(parts.has_attributes()),
      colors_(parts.colors),
      normals_(parts.normals),
      defines_(brick_defines(parts)),
      world_(world) {
    const glm::ivec3 table = world.frame.bricks();
    slots_.assign(size_t(table.x) * size_t(table.y) * size_t(table.z), kBrickOutside);
}

void WorldBricks::store_like(const WorldParts& parts) {
    const size_t voxels = size_t(reserved_) * kVoxels;
    const auto store = [&](auto& buffer, bool& has, bool needs, const char* name, size_t size,
                           auto value) {
        if (has == needs) return;
        buffer = {};
        if (needs) {
            buffer = {device_, name, size};
            buffer.fill(value);
        }
        has = needs;
    };
    store(world_.occupancy, occupancy_, parts.occupancy, kOccupancy, voxels / 64, uint64_t{0});
    store(world_.distance, smooth_, parts.smooth, kDistances, voxels, kSaturated);
    store(world_.attributes, has_attributes_, parts.has_attributes(), kAttributes, voxels,
          world_.attribute);
    store(world_.colors, colors_, parts.colors, kColors, voxels, kWhite);
    store(world_.normals, normals_, parts.normals, kNormals, voxels, uint32_t{VXL_NO_NORMAL});
    defines_ = brick_defines(parts);
}

/// The kernel, built when it is first needed: a world may store no brick.
Kernel WorldBricks::kernel(const char* name) const {
    return Program(device_, "place_bricks.cl", defines_).kernel(name);
}

std::vector<uint32_t> WorldBricks::store(const std::vector<uint32_t>& brick_numbers,
                                         const std::vector<uint8_t>& states) {
    std::vector<uint32_t> gaps, added, stored;
    for (const uint32_t number : brick_numbers) {
        const bool was_stored = slots_[number] < kBrickInside,
                   is_stored = states[number] == kSurface;
        if (is_stored) stored.push_back(number);
        if (was_stored && !is_stored) gaps.push_back(slots_[number]);
        if (!was_stored && is_stored) added.push_back(number);
        if (!is_stored) slots_[number] = states[number] == kFull ? kBrickInside : kBrickOutside;
    }
    for (const uint32_t number : added) {
        if (gaps.empty()) {
            slots_[number] = uint32_t(coordinates_.size());
            coordinates_.push_back(number);
        } else {
            slots_[number] = gaps.back();
            coordinates_[gaps.back()] = number;
            gaps.pop_back();
        }
    }
    reserve(uint32_t(coordinates_.size()));
    fill_gaps(gaps);
    world_.brick_count = uint32_t(coordinates_.size());
    world_.slots = Buffer<uint32_t>(device_, "world slots", slots_);
    world_.coordinates = Buffer<uint32_t>(device_, "world coordinates", coordinates_);
    return stored;
}

/// Moves the last bricks into the slots `gaps`.
void WorldBricks::fill_gaps(const std::vector<uint32_t>& gaps) {
    const auto left = uint32_t(coordinates_.size() - gaps.size());
    std::vector<bool> is_gap(coordinates_.size());
    for (const uint32_t gap : gaps) is_gap[gap] = true;
    std::vector<uint32_t> moves;
    uint32_t last = left;
    for (const uint32_t gap : gaps) {
        if (gap >= left) continue;
        while (is_gap[last]) ++last;
        moves.insert(moves.end(), {last, gap});
        coordinates_[gap] = coordinates_[last++];
        slots_[coordinates_[gap]] = gap;
    }
    coordinates_.resize(left);
    const auto parts = uint32_t(moves.size() / 2 * 64);
    if (parts == 0) return;
    kernel("move_bricks")
        .launch(WorkItem::light, parts, parts, Buffer<uint32_t>(device_, "moved bricks", moves),
                world_.distance, world_.occupancy, world_.attributes, world_.colors,
                world_.normals);
}

void WorldBricks::clear(const std::vector<uint32_t>& brick_numbers) {
    std::vector<uint32_t> slots;
    slots.reserve(brick_numbers.size());
    for (const uint32_t number : brick_numbers) slots.push_back(slots_[number]);
    const auto parts = uint32_t(slots.size() * 64);
    if (parts == 0) return;
    kernel("clear_bricks")
        .launch(WorkItem::light, parts, parts, Buffer<uint32_t>(device_, "cleared bricks", slots),
                world_.distance, world_.occupancy, world_.attributes, world_.colors,
                world_.normals);
}

/// Allocates memory for `bricks` slots. A world that grows once may grow again, so from its second
/// growth on it gets a quarter more, if a buffer may be that large.
void WorldBricks::reserve(uint32_t bricks) {
    if (bricks <= reserved_) return;
    const size_t brick_bytes = kVoxels * (has_attributes_ || colors_ || normals_ ? 4
                                          : smooth_                              ? 2
                                                                                 : 1);
    const size_t maximum = std::max<size_t>(device_.info().max_allocation / brick_bytes, bricks);
    const size_t brick_numbers =
        reserved_ == 0 ? bricks : std::min<size_t>(bricks + bricks / 4, maximum);
    if (occupancy_) enlarge(world_.occupancy, allocate_masks(device_, kOccupancy, brick_numbers));
    if (smooth_) enlarge(world_.distance, allocate_distances(device_, kDistances, brick_numbers));
    if (has_attributes_)
        enlarge(world_.attributes, allocate_words(device_, kAttributes, brick_numbers));
    if (colors_) enlarge(world_.colors, allocate_words(device_, kColors, brick_numbers));
    if (normals_) enlarge(world_.normals, allocate_words(device_, kNormals, brick_numbers));
    reserved_ = uint32_t(brick_numbers);
}

}  // namespace voxelume
