// SPDX-License-Identifier: Apache-2.0
// The opacities of a lattice's voxels whose surfaces let light through.
//
// A surface of opacity a may be shown by N voxels along a sight line, which together must not cover
// 1 - (1 - a)^N. For lines along an axis of the lattice, a voxel's opacity is the part that its
// surfaces cover of the light that the voxels before it let through, on average over the lines of
// its column: so the column's voxels together let through as much as its lines do. For other lines
// a voxel's opacity is 1 - (1 - a)^m, where m is the mean number of crossings of its surfaces with
// sight lines through it: along a sight line these m add up to the number of surfaces.
#pragma once

#include "runtime/image/volume.hpp"
#include "runtime/stages/display/display_lattice.hpp"

namespace voxelume {

/// Memory for the sums of lines along each axis, for each of `voxels` voxels; see cover_lines.
Buffer<uint32_t> allocate_covers(const Device& device, uint32_t voxels);

/// Mean numbers of crossings in a voxel with lines along the three axes, each crossing weighted by
/// -log(1 - a) of its surface's opacity a.
struct MeanCrossings {
    glm::dvec3 out{0}, in{0}, cubes{0};
};

/// The mean number of crossings of the sight lines for which the voxel's opacity holds.
///
/// A surface with the area vector S is crossed |S . d| times by lines along d, one for each unit of
/// area, and the crossings with lines along the axes are the components of S. A voxel whose lines
/// enter and leave surfaces along one axis has two surfaces, whose crossings add up.
double mean_crossings(const VolumeFrame& frame, const glm::ivec3& cell,
                      const MeanCrossings& along_axes);

/// The axis of the lines for which a voxel's opacity holds; -1 for lines along no axis.
int axis_seen_along(const VolumeFrame& frame, const MeanCrossings& along_axes);

/// The kernel of display_cover.cl.
class DisplayCoverStage {
  public:
    /// The voxels' objects and opacities must be known.
    DisplayCoverStage(const Device& device, const Features& features, const VolumeFrame& frame,
                      const GridFrame& world, const ShownVoxels& shown);

    /// Adds the crossings of a part of the lines along `axis`.
    void add(int axis, const LinePoints& lines, const LineSurfaces& surfaces,
             const Buffer<uint32_t>& mask);

    /// Changes the opacities of a volume's voxels. `lines` is the number of lines in a voxel along
    /// each axis.
    void adjust(const glm::uvec3& lines, Volume& volume) const;

  private:
    DisplayLattice lattice_;
    const ShownVoxels& shown_;
    Buffer<uint32_t> logs_, covers_;
    Program program_;
    Kernel cover_;
};

}  // namespace voxelume
