// SPDX-License-Identifier: Apache-2.0
// world + lattice of a display -> probe points: the points where its probe lines cross surfaces.
#pragma once

#include <functional>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/display/display_frame.hpp"
#include "runtime/stages/display/line_surfaces.hpp"
#include "runtime/stages/display/probe_points.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {

inline constexpr uint32_t kFirstSlots = 64;  ///< that each line has at first

/// The number of lines that are scanned together with a batch of `rays` rays.
uint32_t scanned_lines(uint32_t rays);

/// The kernels of display_scan.cl: probe lines along the three axes of a lattice.
///
/// The lines are all those of the lattice's edges, with parallel lines between them, up to 64 in a
/// voxel, so that no gap is wider than a voxel of the world. Lines that miss the world are left
/// out, and so are rows of four lines that all miss its objects.
class DisplayScanStage {
  public:
    /// `surfaces` are needed for features with `transmission`. Throws Error::limit if more than
    /// 2^31 lines along an axis meet the world.
    DisplayScanStage(const Device& device, const Features& features, const VolumeFrame& frame,
                     const GridFrame& world, LineSurfaces surfaces);

    /// The crossings of all lines, in pieces from parts of a batch. `batch` holds the rays
    /// meanwhile.
    std::vector<ProbePoints> scan(const Pyramid& world, RayBatch& batch);

    /// The points of a part of the lines along `axis`.
    using PointSink = std::function<void(int axis, LinePoints points)>;

    /// Calls `sink` with the points where lines cross surfaces or enter a cube, which are what
    /// sight rays count, too. These lines lie inside the voxels of `frame`.
    void scan_covers(const VolumeFrame& frame, const Pyramid& world, RayBatch& batch,
                     const PointSink& sink);

    /// The number of lines in a voxel along `axis` for scan_covers(); 0 if none are needed.
    int cover_lines(int axis) const;

    const LineSurfaces& surfaces() const { return surfaces_; }
    uint64_t lines() const { return lines_; }              ///< number of lines cast so far
    uint64_t clear_lines() const { return clear_lines_; }  ///< number of lines left out so far

  private:
    /// The lines along one axis.
    struct Family {
        int axis;
        glm::ivec2 parts;  ///< number of lines in a voxel, along the next axis and along the one
                           ///< after it
        glm::ivec2 last;   ///< number of the last line along each, in parts from the corner
        int count;         ///< number of lines along the second axis in the whole lattice
        Camera camera;
        float4 row;         ///< row of the lattice coordinate along the lines
        float4 row_second;  ///< row of the second coordinate across them
        glm::vec2 offset;   ///< offset of the lines from the edges of parts, in parts
    };
    Family family(int axis, const VolumeFrame& frame, const GridFrame& world,
                  const glm::ivec2& parts, const glm::vec2& offset) const;
    Family edge_lines(int axis, const VolumeFrame& frame, const GridFrame& world) const;
    /// The rows of tiles with the lines that meet `box`: the first, and one beyond the last.
    static glm::uvec2 rows_across(const Family& family, const VoxelBox& box);
    LinePoints scan_batch(const Pyramid& world, const Family& family, uint32_t first_line,
                          uint32_t count, RayBatch& batch);
    void scan_families(const Pyramid& world, const std::vector<Family>& families, RayBatch& batch,
                       const PointSink& sink);

    Device device_;
    DisplayLattice lattice_;
    CoverAxes seen_along_;
    std::vector<Family> families_;
    SightStage camera_;
    Program program_;
    Kernel scan_, pack_, order_;
    LineSurfaces surfaces_;
    bool transmission_;
    bool covers_ = false;           ///< see scan_lines
    uint32_t slots_ = kFirstSlots;  ///< number of crossings that a line has room for; it grows
    CrossingArrays crossed_;
    uint64_t lines_ = 0, clear_lines_ = 0;
};

}  // namespace voxelume
