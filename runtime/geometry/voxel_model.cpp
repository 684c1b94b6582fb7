// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/voxel_model.hpp"

#include <bit>
#include <cstdlib>
#include <span>

#include "runtime/base/ranges.hpp"

namespace voxelume {

size_t bricks_of(const GridFrame& frame) {
    const glm::ivec3 bricks = frame.bricks();
    return size_t(bricks.x) * size_t(bricks.y) * size_t(bricks.z);
}

size_t VoxelModel::voxels() const {
    size_t count = 0;
    for (const uint64_t mask : occupancy) count += size_t(std::popcount(mask));
    for (const int16_t d : distance) count += std::abs(d) < kDistanceUnitsPerVoxel;
    return count;
}

void VoxelModel::widen_colors() {
    if (color_codes.empty()) return;
    reserve_in_huge_pages(colors, color_codes.size());
    for (const uint8_t code : color_codes) colors.push_back(palette[code]);
    color_codes = {};
}

namespace {

/// The colours that codes stand for, written to where kernels read them.
Buffer<uint32_t> widened(const Device& device, const VoxelModel& model) {
    Buffer<uint32_t> colors(device, "model colors", model.color_codes.size());
    colors.write_in_place([&](std::span<uint32_t> words) {
        const auto bricks = int(model.coordinates.size());
        for_ranges(bricks, words.size(), [&](int first, int end) {
            const size_t from = size_t(first) * kVoxelsPerBrick, to = size_t(end) * kVoxelsPerBrick;
            for (size_t i = from; i < to; ++i) words[i] = model.palette[model.color_codes[i]];
        });
    });
    return colors;
}

}  // namespace

BrickGrid VoxelModel::upload(const Device& device) const {
    BrickGrid grid;
    grid.frame = frame;
    grid.brick_count = uint32_t(coordinates.size());
    grid.slots = {device, "model slots", slots};
    grid.coordinates = {device, "model coordinates", coordinates};
    grid.occupancy = {device, "model occupancy", occupancy};
    grid.distance = {device, "model distances", distance};
    grid.attributes = {device, "model attributes", attributes};
    if (color_codes.empty())
        grid.colors = {device, "model colors", colors};
    else
        grid.colors = widened(device, *this);
    grid.normals = {device, "model normals", normals};
    grid.transparent = transparent;
    return grid;
}

}  // namespace voxelume
