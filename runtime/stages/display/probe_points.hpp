// SPDX-License-Identifier: Apache-2.0
// Probe points of a lattice and crossings of its probe lines, as kernels take them.
#pragma once

#include "kernels/shared/display.h"
#include "runtime/opencl/program.hpp"

namespace voxelume {

/// Probe points in lattice voxels, in an order that depends on the world and the lattice alone.
struct ProbePoints {
    int axis = 0;  ///< axis of the points' lines
    uint32_t count = 0;
    uint32_t total = 0;         ///< room in each array, a multiple of 16
    Buffer<float> coordinates;  ///< x, y, z, `total` apart
    Buffer<uint32_t> views;     ///< a view in which each point is visible; kNoView for none
};

/// The points of lines, one line after another, and the surface that a line crosses at each, for
/// lines that scan_covers() sends.
struct LinePoints {
    ProbePoints points;
    uint32_t lines = 0;
    Buffer<uint32_t> starts;    ///< the number of each line's first point, and of all points
    Buffer<uint32_t> surfaces;  ///< surface of each point, see line_order.h
};
inline constexpr uint32_t kNoView = 0xFFFFFFFFu;

/// VXL_LINE_PARAMETERS of display_cover.cl.
void bind(KernelArguments& to, const LinePoints& lines);

/// VXL_POINTS_PARAMETERS of kernels.
void bind(KernelArguments& to, const ProbePoints& points);

/// Where the voxels of a lattice are looked at from: VXL_VIEW_PARAMETERS of kernels.
struct ProbeViews {
    const Camera& camera;
    PyramidShape world;
    const DisplayLattice& lattice;
    const Buffer<float4>& views;
};
void bind(KernelArguments& to, const ProbeViews& views);

/// The crossings of lines with surfaces: VXL_CROSSINGS_PARAMETERS of display_scan.cl.
struct CrossingArrays {
    Buffer<uint32_t> counts;  ///< of each line
    Buffer<float> crossings;
    Buffer<uint32_t> surfaces;  ///< only where light goes through some
};
void bind(KernelArguments& to, const CrossingArrays& arrays);

/// Arrays for `count` points, which have no views yet; and arrays for the crossings of `lines`
/// lines, with `slots` slots for each, and for their surfaces.
/// The number of `count` points from `first` on that have a view. Waits for the device.
uint32_t points_seen(const ProbePoints& points, uint32_t first, uint32_t count);

ProbePoints allocate_points(const Device& device, uint32_t count);
Buffer<float> allocate_crossings(const Device& device, uint32_t lines, uint32_t slots);
Buffer<uint32_t> allocate_surfaces(const Device& device, uint32_t lines, uint32_t slots);

}  // namespace voxelume
