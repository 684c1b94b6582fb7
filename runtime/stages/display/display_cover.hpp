// SPDX-License-Identifier: Apache-2.0
// The opacities of a lattice's voxels whose surfaces let light through.
//
// A surface of opacity a that N voxels on a sight line show must not cover by 1 - (1 - a)^N. Along
// an axis of the lattice a voxel covers what its surfaces take of the light that the voxels before
// it let through, on average over the lines of its column: so the column's voxels together let
// through what its lines do. Along other lines a voxel gets 1 - (1 - a)^m, where m is how often
// sight lines through it cross surfaces in it on average: along the line these m add up to the
// number of surfaces.
#pragma once

#include "runtime/image/volume.hpp"
#include "runtime/stages/display/display_lattice.hpp"

namespace voxelume {

/// Memory for the sums of lines along each axis, for each of `voxels` voxels; see cover_lines.
Buffer<uint32_t> allocate_covers(const Device& device, uint32_t voxels);

/// Mean numbers of crossings of lines along the three axes in a voxel, each of them times
/// -log(1 - a) of its surface's opacity a.
struct MeanCrossings {
    glm::dvec3 out{0}, in{0}, cubes{0};
};

/// The mean number of crossings of the sight lines for which the voxel's opacity is meant.
///
/// A surface with the area vector S is crossed |S . d| times by lines along d, one for each unit of
/// area, and what lines along the axes cross are the components of S. A voxel whose lines go in as
/// well as out along one axis has two surfaces, whose crossings add up.
double mean_crossings(const VolumeFrame& frame, const glm::ivec3& cell,
                      const MeanCrossings& along_axes);

/// The axis along which a voxel's opacity is meant; -1 for lines that lead along none.
int axis_seen_along(const VolumeFrame& frame, const MeanCrossings& along_axes);

/// VXL_LINE_PARAMETERS of display_cover.cl.
void bind(KernelArguments& to, const LinePoints& lines);

/// The kernel of display_cover.cl.
class DisplayCoverStage {
  public:
    /// The voxels' objects and opacities are known.
    DisplayCoverStage(const Device& device, const Features& features, const VolumeFrame& frame,
                      const GridFrame& world, const ShownVoxels& shown);

    /// Adds a part of the lines along `axis`.
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
