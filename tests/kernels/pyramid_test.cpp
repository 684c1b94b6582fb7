// SPDX-License-Identifier: Apache-2.0
// The values that kernels read in a pyramid, cell by cell, against the voxels themselves.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "runtime/opencl/program.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/trace/trace.hpp"
#include "tests/support/brick_grids.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

// The kernel writes for each cell the log2 of the empty block around it, or -1 for a voxel.
constexpr const char* kPyramidSource = R"(
#include "lib/traverse/pyramid.h"
#include "lib/lanes/work_item.h"
kernel void look_at_cells(PyramidShape shape, global const uint* restrict sectors,
                          global const uint* restrict bricks, global const uint* restrict leaves,
                          global const uint* restrict leaf_voxels, uint count,
                          global int* restrict sizes) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const PyramidView p = pyramid_view(shape, sectors, bricks, leaves, leaf_voxels);
    const lane_int cell = LANES_NUMBERS + (int)first;
    const lane_int active = LANE_MASK(cell < (int)count);
    const lane_int known = cell & active, row = known / shape.size_x;
    LastSector last = no_sector();
    const CellState state = look_up(&p, known % shape.size_x, row % shape.size_y,
                                    row / shape.size_y, active, &last);
    LANES_STORE(LANES_SELECT(state.occupied, (lane_int)-1, state.log2_size), sizes, first);
})";

std::vector<int> sizes_of(const Device& device, const Pyramid& pyramid) {
    const glm::ivec3 size = pyramid.frame.size;
    const auto count = uint32_t(size.x * size.y * size.z);
    Buffer<int> sizes(device, "sizes", (count + 15) / 16 * 16);
    Program::from_text(device, kPyramidSource, {})
        .kernel("look_at_cells")
        .launch_packets(count, shape_of(pyramid), pyramid.sectors, pyramid.bricks, pyramid.leaves,
                        pyramid.leaf_voxels, count, sizes);
    return sizes.read(0, count);
}

/// The blocks of 1 << log2 cells that hold voxels, by their indices along the axes.
std::set<std::array<int, 3>> blocks_with_voxels(const VoxelMap& voxels, int log2) {
    std::set<std::array<int, 3>> blocks;
    for (const auto& [voxel, word] : voxels)
        blocks.insert({voxel[0] >> log2, voxel[1] >> log2, voxel[2] >> log2});
    return blocks;
}

class LookUp : public ::testing::TestWithParam<int> {};

TEST_P(LookUp, TellsTheLargestEmptyBlockAroundEveryCell) {
    constexpr int kLargest = 8;
    constexpr uint32_t kSeed = 20261122;
    std::mt19937 random(kSeed);
    const glm::ivec3 size{300, 70, 90};
    VoxelMap voxels = {{{3, 2, 1}, 0}, {{40, 37, 21}, 0}, {{41, 37, 21}, 0}};
    for (int i = 0; i < 200; ++i)  // in one corner, so that blocks of all sizes occur
        voxels[{random() % 37, random() % 29, random() % 33}] = 0;
    const Device device = test_device(GetParam());
    const std::vector<int> sizes = sizes_of(
        device, build_index(device, occupied_bricks(frame_of(size), voxels).upload(device)));
    std::vector<std::set<std::array<int, 3>>> blocks;
    for (int log2 = 0; log2 <= kLargest; ++log2) blocks.push_back(blocks_with_voxels(voxels, log2));
    std::vector<int> seen(kLargest + 1);
    size_t wrong = 0;
    for (size_t cell = 0; cell < sizes.size(); ++cell) {
        const auto number = int(cell);
        const glm::ivec3 v{number % size.x, number / size.x % size.y, number / size.x / size.y};
        int largest = kLargest;
        while (largest >= 0 &&
               blocks[size_t(largest)].contains({v.x >> largest, v.y >> largest, v.z >> largest}))
            --largest;
        if (largest == 7) largest = 6;  // a sector reports only groups of 4 x 4 x 4
        if (largest >= 0) ++seen[size_t(largest)];
        if (sizes[cell] != largest && wrong++ < 5)
            ADD_FAILURE() << v.x << ' ' << v.y << ' ' << v.z << ": " << sizes[cell]
                          << " instead of " << largest;
    }
    EXPECT_EQ(wrong, 0u) << "seed " << kSeed;
    for (const int log2 : {0, 1, 2, 3, 4, 5, 6, 8})
        EXPECT_GT(seen[size_t(log2)], 0) << "no block of " << (1 << log2);
}

INSTANTIATE_TEST_SUITE_P(Lanes, LookUp, ::testing::Values(1, 4, 8, 16));

}  // namespace
}  // namespace voxelume
