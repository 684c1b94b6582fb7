// SPDX-License-Identifier: Apache-2.0
// array of voxels -> bricks. Two passes over the array: the first finds which bricks have voxels,
// the second fills these.
#include "runtime/api/voxel_array.hpp"

#include <algorithm>

#include "kernels/shared/voxel.h"
#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/geometry/voxel_model.hpp"
#include "runtime/grid/brick_cells.hpp"
#include "runtime/io/voxels/voxel_limits.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kNoColor = 0xFFFFFF;  // colour of cells without a voxel

std::array<std::ptrdiff_t, 3> strides_of(const v1::VoxelArray& array) {
    if (array.strides) return *array.strides;
    const std::ptrdiff_t row = 4 * std::ptrdiff_t(array.size[0]);
    return {4, row, row * array.size[1]};
}

void check(const v1::VoxelArray& array) {
    const auto [x, y, z] = array.size;
    if (array.name.empty()) throw Error(ErrorKind::usage, "an array of voxels needs a name");
    if (std::min({x, y, z}) < 1 || !array.rgba)
        throw Error(ErrorKind::usage, "{}: an array of {} x {} x {} has no voxels",
                    quote(array.name), x, y, z);
    double bricks = 1;
    for (const int side : array.size) {
        const int along = (std::min(side, kMaxVoxelsPerAxis) + 2 * kModelMargin) / kBrickSize + 1;
        bricks *= along;
    }
    if (std::max({x, y, z}) > kMaxVoxelsPerAxis - 2 * kModelMargin || bricks > kMaxBricks)
        throw Error(ErrorKind::limit,
                    "{}: an array of {} x {} x {} is too large: at most {} voxels along each axis "
                    "and {} bricks of 16 in all are possible",
                    quote(array.name), x, y, z, kMaxVoxelsPerAxis - 2 * kModelMargin, kMaxBricks);
}

/// Calls `act` with the cell of each voxel, counted with the margin, and its bytes.
template <class Act>
void for_voxels(const v1::VoxelArray& array, const Act& act) {
    const auto strides = strides_of(array);
    for (int z = 0; z < array.size[2]; ++z)
        for (int y = 0; y < array.size[1]; ++y) {
            const uint8_t* voxel = array.rgba + y * strides[1] + z * strides[2];
            for (int x = 0; x < array.size[0]; ++x, voxel += strides[0])
                if (voxel[3] != 0) act(glm::ivec3(x, y, z) + kModelMargin, voxel);
        }
}

void number_bricks(const v1::VoxelArray& array, VoxelModel& model) {
    const glm::ivec3 bricks = model.frame.bricks();
    model.slots.assign(bricks_of(model.frame), kBrickOutside);
    for_voxels(array, [&](const glm::ivec3& cell, const uint8_t*) {
        model.slots[brick_of(cell, bricks)] = 0;
    });
    for (size_t brick = 0; brick < model.slots.size(); ++brick) {
        if (model.slots[brick] == kBrickOutside) continue;
        model.slots[brick] = uint32_t(model.coordinates.size());
        model.coordinates.push_back(uint32_t(brick));
    }
    if (model.coordinates.empty())
        throw Error(ErrorKind::usage, "{}: no voxel of the array is there: all opacities are 0",
                    quote(array.name));
    if (model.coordinates.size() > kMaxStoredBricks)
        throw Error(ErrorKind::limit,
                    "{}: its voxels lie in {} bricks of 16 x 16 x 16, at most {} are possible",
                    quote(array.name), model.coordinates.size(), kMaxStoredBricks);
}

VoxelModel model_of(const v1::VoxelArray& array) {
    check(array);
    VoxelModel model;
    model.surface = Surface::cubes;
    model.frame.size = glm::ivec3(array.size[0], array.size[1], array.size[2]) + 2 * kModelMargin;
    model.frame.origin = glm::dvec3(-kModelMargin);
    number_bricks(array, model);
    model.occupancy.assign(model.coordinates.size() * kLeavesPerBrick, 0);
    model.colors.assign(model.coordinates.size() * kVoxelsPerBrick, kNoColor);
    const glm::ivec3 bricks = model.frame.bricks();
    for_voxels(array, [&](const glm::ivec3& cell, const uint8_t* rgba) {
        const size_t slot = model.slots[brick_of(cell, bricks)];
        const glm::ivec3 in = cell % kBrickSize;
        model.occupancy[slot * kLeavesPerBrick + leaf_in_brick(in)] |= bit_in_leaf(in);
        model.transparent |= rgba[3] < 255;
        model.colors[slot * kVoxelsPerBrick + voxel_in_brick(in)] =
            uint32_t(rgba[0]) | uint32_t(rgba[1]) << 8 | uint32_t(rgba[2]) << 16 |
            uint32_t(255 - rgba[3]) << VXL_TRANSPARENCY_SHIFT;
    });
    return model;
}

}  // namespace

GivenVoxels api::given_voxels(std::span<const v1::VoxelArray> arrays) {
    GivenVoxels given;
    for (const v1::VoxelArray& array : arrays)
        if (!given.emplace(array.name, std::make_shared<const VoxelModel>(model_of(array))).second)
            throw Error(ErrorKind::usage, "two arrays of voxels have the name {}",
                        quote(array.name));
    return given;
}

}  // namespace voxelume
