// SPDX-License-Identifier: Apache-2.0
// The opacities of a lattice's voxels whose surfaces let light through.
//
// A surface of opacity a that N voxels on a sight line show must not cover by 1 - (1 - a)^N. So a
// voxel gets 1 - (1 - a)^m, where m is how often sight lines through it cross surfaces in it on
// average: along the line these m add up to the number of surfaces.
#pragma once

#include "runtime/image/volume.hpp"
#include "runtime/stages/display/display_lattice.hpp"

namespace voxelume {

/// How often lines along each axis cross surfaces in each of `voxels` voxels, in each sense.
Buffer<uint32_t> allocate_covers(const Device& device, uint32_t voxels);

/// The mean number of crossings of lines along the three axes in a voxel.
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

/// The kernel of display_cover.cl.
class DisplayCoverStage {
  public:
    DisplayCoverStage(const Device& device, const Features& features, const VolumeFrame& frame,
                      const GridFrame& world, const ShownVoxels& shown);

    /// Adds the points of a part of the lines along `axis`.
    void count(int axis, const ProbePoints& points, const Buffer<uint32_t>& mask);

    /// Changes the opacities of a volume's voxels. `lines` is the number of lines in a voxel along
    /// each axis.
    void adjust(const glm::uvec3& lines, Volume& volume) const;

  private:
    DisplayLattice lattice_;
    const ShownVoxels& shown_;
    Buffer<uint32_t> covers_;
    Program program_;
    Kernel count_;
};

}  // namespace voxelume
