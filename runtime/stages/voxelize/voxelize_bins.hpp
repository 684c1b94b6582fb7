// Triangles sorted into the bricks that they reach: what every kernel of voxelization gathers from.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "runtime/opencl/buffer.hpp"
#include "runtime/opencl/program.hpp"

namespace voxelume {

/// Triangles first .. first + count - 1 of a mesh's lattice on a device.
struct DeviceTriangles {
    uint32_t first = 0, count = 0;
    Buffer<int32_t> vertices;    ///< 3 per vertex
    Buffer<uint32_t> triangles;  ///< 3 per triangle
};

/// Bins that hold triangles: first the frame's bricks, ascending, then the column left of the
/// frame.
struct TriangleBins {
    glm::ivec4 size{0};         ///< bricks of the frame, x one more: x = 0 is left of the frame
    uint32_t count = 0;         ///< bins with triangles
    uint32_t stored = 0;        ///< those that are bricks of the frame: their slots
    Buffer<uint32_t> occupied;  ///< index of each
    Buffer<uint32_t> number_of_bin;  ///< the inverse; kBrickOutside for a bin without triangles
    Buffer<uint32_t> coordinates;    ///< one per slot: index of the brick in the frame
    Buffer<uint32_t> first;          ///< count + 1: where each one's triangles start in `lists`
    Buffer<uint32_t> lists;          ///< triangles' numbers, in no particular order
};

/// What sorting finds.
struct BinCounts {
    size_t bins = 0;      ///< of the frame, and of the column left of it
    size_t occupied = 0;  ///< those that hold triangles
    size_t stored = 0;    ///< of these, the frame's
    size_t pairs = 0;     ///< of a triangle and a bin
};

/// The arrays of a mesh's lattice, of bins, and of the places up to which bins are filled.
DeviceTriangles allocate_triangles(const Device& device, size_t vertices, size_t triangles);
TriangleBins allocate_bins(const Device& device, const BinCounts& counts);
Buffer<uint32_t> allocate_cursors(const Device& device, size_t bins);

/// Turns counts into where each one's share starts; returns the total. Throws Error::limit for
/// 2^32.
uint64_t starts_of_counts(std::vector<uint32_t>& counts);

/// Sorts triangles into the bricks of `bricks` whose closed boxes of `extent` lattice units they
/// come within `reach` (lattice units along each axis) of.
TriangleBins bin_triangles(const Device& device, const Program& program,
                           const DeviceTriangles& triangles, const glm::ivec3& bricks,
                           const glm::ivec3& reach, int extent);

}  // namespace voxelume
