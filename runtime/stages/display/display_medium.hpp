// SPDX-License-Identifier: Apache-2.0
// medium of S + lattice of a display -> the voxels of space in P.
#pragma once

#include <functional>
#include <vector>

#include "runtime/image/volume.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/display/display_frame.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/medium/density_grid.hpp"

namespace voxelume {

/// Voxels of a lattice that hold medium, ascending in `indices`.
struct MediumVoxels {
    std::vector<uint64_t> indices;
    std::vector<float> densities;   ///< the mean over each voxel
    std::vector<glm::vec3> colors;  ///< the mean of density times colour; empty for one colour
};

/// Appends voxel `i` of a list to another.
void append(const MediumVoxels& from, size_t i, MediumVoxels& to);

/// The number of rows along x of a lattice that are measured together.
uint32_t medium_rows(const glm::ivec3& size);

/// The means of the voxels of these rows.
Buffer<float> allocate_medium_means(const Device& device, const Features& features,
                                    const glm::ivec3& size);

/// The kernel of display_medium.cl.
class DisplayMediumStage {
  public:
    DisplayMediumStage(const Device& device, const Features& features, const VolumeFrame& frame,
                       const Pyramid& world);

    /// Calls `sink` with the voxels that hold medium, part by part. `density` is empty for a medium
    /// that has density 1 in all of the world.
    void measure(const DensityGrid& density, const std::function<void(MediumVoxels)>& sink);

  private:
    MediumVoxels listed(uint32_t first_row, uint32_t rows) const;

    DisplayLattice lattice_;
    PyramidShape world_;
    bool has_colors_;
    glm::uvec2 lines_;
    Buffer<float> means_;
    Program program_;
    Kernel measure_;
};

/// Adds voxels of the medium to a volume of layout `lattice`, whose own voxels are surfaces.
///
/// A voxel of the medium has the opacity and the light of a way through it, with the length of
/// way_through(). Where a voxel shows a surface that lets light through, the medium lies in front
/// of one half of the surface and behind the other.
void add_medium_voxels(const MediumVoxels& voxels, const Medium& medium, Volume& volume);

/// The length of the way through a voxel for which the display's opacities hold, in metres.
double way_through(const VolumeFrame& frame, const glm::ivec3& cell);

}  // namespace voxelume
