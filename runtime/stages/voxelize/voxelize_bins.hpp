// SPDX-License-Identifier: Apache-2.0
// Triangles sorted into the bricks that they meet: the input of every kernel of voxelization.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "runtime/opencl/buffer.hpp"
#include "runtime/opencl/program.hpp"

namespace voxelume {

/// Triangles first .. first + count - 1 of a mesh's lattice, on a device.
struct DeviceTriangles {
    uint32_t first = 0, count = 0;
    Buffer<int32_t> vertices;    ///< 3 per vertex
    Buffer<uint32_t> triangles;  ///< 3 per triangle
};

/// VXL_MESH_PARAMETERS of kernels.
void bind(KernelArguments& to, const DeviceTriangles& triangles);

/// Bins that hold triangles: first the frame's bricks, ascending, then the column left of the
/// frame.
struct TriangleBins {
    glm::ivec4 size{0};  ///< bricks of the frame, with one more along x: x = 0 is left of the frame
    uint32_t count = 0;  ///< number of bins with triangles
    uint32_t stored = 0;  ///< number of those that are bricks of the frame; each has its number as
                          ///< its slot
    Buffer<uint32_t> occupied;       ///< the index of each bin with triangles
    Buffer<uint32_t> number_of_bin;  ///< the inverse of `occupied`; kBrickOutside for a bin without
                                     ///< triangles
    Buffer<uint32_t> coordinates;    ///< one per slot: the index of the brick in the frame
    Buffer<uint32_t> first;          ///< count + 1: where each bin's triangles start in `lists`
    Buffer<uint32_t> lists;          ///< triangles' numbers, in no particular order
};

/// VXL_BINS_PARAMETERS of kernels.
void bind(KernelArguments& to, const TriangleBins& bins);

/// The counts that sorting yields.
struct BinCounts {
    size_t bins = 0;      ///< bins of the frame, and of the column left of it
    size_t occupied = 0;  ///< bins with triangles
    size_t stored = 0;    ///< bins with triangles in the frame
    size_t pairs = 0;     ///< pairs of a triangle and a bin
};

/// The arrays of a mesh's lattice, of bins, and of the current ends of bins' lists.
DeviceTriangles allocate_triangles(const Device& device, size_t vertices, size_t triangles);
TriangleBins allocate_bins(const Device& device, const BinCounts& counts);
Buffer<uint32_t> allocate_cursors(const Device& device, size_t bins);

/// Turns counts into the starts of ranges; returns the total. Throws Error::limit for 2^32.
uint64_t starts_of_counts(std::vector<uint32_t>& counts);

/// Sorts triangles into bricks: a triangle is in the bin of each brick whose closed box of `extent`
/// lattice units it comes within `reach` of (lattice units along each axis). `bricks` is the
/// frame's number of bricks.
TriangleBins bin_triangles(const Device& device, const Program& program,
                           const DeviceTriangles& triangles, const glm::ivec3& bricks,
                           const glm::ivec3& reach, int extent);

}  // namespace voxelume
