// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxel_art/cube_list.hpp"

#include <array>
#include <bit>
#include <climits>
#include <cstdint>
#include <glm/vector_relational.hpp>

#include "kernels/shared/voxel.h"
#include "runtime/base/error.hpp"
#include "runtime/base/text.hpp"
#include "runtime/grid/brick_cells.hpp"

namespace voxelume {
namespace {

constexpr size_t kMaxCubes = size_t{1} << 28;

void add_stored(const VoxelModel& model, size_t slot, CubeList& cubes) {
    const glm::ivec3 first = brick_corner(model.frame, model.coordinates[slot]);
    for (size_t leaf = 0; leaf < kLeavesPerBrick; ++leaf)
        for (uint64_t bits = model.occupancy[slot * kLeavesPerBrick + leaf]; bits != 0;
             bits &= bits - 1) {
            const glm::ivec3 in = leaf_corner(leaf) + cell_in_leaf(std::countr_zero(bits));
            cubes.cells.push_back(first + in);
            const size_t index = slot * kVoxelsPerBrick + voxel_in_brick(in);
            if (!model.colors.empty()) cubes.colors.push_back(model.colors[index]);
            if (!cubes.materials.empty())
                cubes.material_numbers.push_back(
                    uint16_t(model.attributes[index] >> VXL_MATERIAL_SHIFT & VXL_MATERIAL_MASK));
        }
}

void add_full(const VoxelModel& model, size_t brick, CubeList& cubes) {
    const glm::ivec3 first = brick_corner(model.frame, brick);
    for (size_t i = 0; i < kVoxelsPerBrick; ++i) cubes.cells.push_back(first + cell_in_brick(i));
    if (!model.colors.empty())
        cubes.colors.resize(cubes.cells.size(),
                            model.full_colors.empty() ? 0xFFFFFF : model.full_colors[brick]);
    if (!cubes.materials.empty()) {
        const uint16_t last = cubes.material_numbers.empty() ? 0 : cubes.material_numbers.back();
        cubes.material_numbers.resize(cubes.cells.size(), last);
    }
}

[[noreturn]] void refuse_empty() {
    throw Error(ErrorKind::input, "there are no voxels to write");
}

/// The smallest box of cells that contains all cells added so far.
struct CellBox {
    glm::ivec3 low{INT_MAX}, high{INT_MIN};

    void add(const glm::ivec3& first, const glm::ivec3& last) {
        low = glm::min(low, first);
        high = glm::max(high, last);
    }
};

/// The distance at a node, in units; the limit of distances where none is stored.
int distance_at(const VoxelModel& model, const glm::ivec3& node) {
    const glm::ivec3 bricks = model.frame.bricks(), brick = node / kBrickSize,
                     in = node % kBrickSize;
    if (glm::any(glm::greaterThanEqual(brick, bricks))) return INT16_MAX;
    const uint32_t slot =
        model.slots[size_t(brick.x) + size_t(bricks.x) * size_t(brick.y + bricks.y * brick.z)];
    if (slot >= kBrickInside) return slot == kBrickInside ? INT16_MIN : INT16_MAX;
    return model.distance[slot * kVoxelsPerBrick + voxel_in_brick(in)];
}

/// A number with the sign of the distance at a voxel's middle.
int sum_of_corners(const VoxelModel& model, const glm::ivec3& voxel) {
    int sum = 0;
    for (int corner = 0; corner < 8; ++corner)
        sum += distance_at(model, voxel + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2));
    return sum;
}

}  // namespace

glm::ivec3 size_of_cubes(const VoxelModel& model) {
    CellBox box;
    for (size_t brick = 0; brick < model.slots.size(); ++brick) {
        const size_t slot = model.slots[brick];
        if (slot == kBrickOutside) continue;
        const glm::ivec3 first = brick_corner(model.frame, brick);
        if (slot == kBrickInside) box.add(first, first + kBrickSize - 1);
        if (slot == kBrickInside) continue;
        for (size_t leaf = 0; leaf < kLeavesPerBrick; ++leaf)
            for (uint64_t bits = model.occupancy[slot * kLeavesPerBrick + leaf]; bits != 0;
                 bits &= bits - 1) {
                const glm::ivec3 cell =
                    first + leaf_corner(leaf) + cell_in_leaf(std::countr_zero(bits));
                box.add(cell, cell);
            }
    }
    if (box.high.x < box.low.x) refuse_empty();
    return box.high - box.low + 1;
}

VoxelModel cubes_inside(const VoxelModel& smooth) {
    VoxelModel cubes;
    cubes.surface = Surface::cubes;
    cubes.set = VoxelSet::solid;
    cubes.frame = smooth.frame;
    cubes.slots = smooth.slots;
    cubes.coordinates = smooth.coordinates;
    cubes.occupancy.resize(smooth.coordinates.size() * kLeavesPerBrick);
    for (size_t slot = 0; slot < smooth.coordinates.size(); ++slot)
        for (size_t i = 0; i < kVoxelsPerBrick; ++i) {
            const glm::ivec3 in = cell_in_brick(i);
            if (sum_of_corners(smooth, brick_corner(smooth.frame, smooth.coordinates[slot]) + in) <
                0)
                cubes.occupancy[slot * kLeavesPerBrick + leaf_in_brick(in)] |= bit_in_leaf(in);
        }
    return cubes;
}

CubeList cube_list(const VoxelModel& model, std::span<const CubeMaterial> materials) {
    CubeList cubes;
    if (!model.attributes.empty()) cubes.materials.assign(materials.begin(), materials.end());
    size_t count = 0;
    for (const uint64_t bits : model.occupancy) count += size_t(std::popcount(bits));
    for (const uint32_t slot : model.slots) count += slot == kBrickInside ? kVoxelsPerBrick : 0;
    if (count > kMaxCubes)
        throw Error(ErrorKind::limit, "there are {} voxels; at most {} can be written to this file",
                    count, kMaxCubes);
    cubes.cells.reserve(count);
    cubes.origin = model.frame.origin;
    cubes.voxel_edge = model.frame.voxel_edge;
    for (size_t brick = 0; brick < model.slots.size(); ++brick) {
        if (model.slots[brick] == kBrickInside) add_full(model, brick, cubes);
        if (model.slots[brick] < kBrickInside) add_stored(model, model.slots[brick], cubes);
    }
    shrink(cubes);
    return cubes;
}

void shrink(CubeList& cubes) {
    if (cubes.cells.empty()) refuse_empty();
    CellBox box;
    for (const glm::ivec3& cell : cubes.cells) box.add(cell, cell);
    for (glm::ivec3& cell : cubes.cells) cell -= box.low;
    cubes.origin += cubes.voxel_edge * glm::dvec3(box.low);
    cubes.size = box.high - box.low + 1;
}

}  // namespace voxelume
