// SPDX-License-Identifier: Apache-2.0
// display -> the lattice V of its voxels: their positions, for the host and for kernels.
#pragma once

#include "kernels/shared/display.h"
#include "runtime/grid/grid_frame.hpp"
#include "runtime/image/volume.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The voxels of the scene's display in its layout, as in `Volume::frame`.
VolumeFrame display_frame(const Scene& scene);

/// The steps along depth of a frame of layout `rays` in a world with this medium.
DisplaySteps display_steps(const VolumeFrame& frame, const Medium& medium);

/// The lattice of a frame of layout `lattice` in a world.
DisplayLattice display_lattice(const VolumeFrame& frame, const GridFrame& world);

/// The axes of the lattice along which its opacities are measured.
enum class CoverAxes : uint8_t {
    x,
    y,
    z,
    all,     ///< all axes; a voxel's opacity is that along one of them
    oblique  ///< all axes; opacities along other lines are computed from these
};
CoverAxes cover_axes(const Display& display);

}  // namespace voxelume
