// SPDX-License-Identifier: Apache-2.0
// scene and world -> P in the layout `lattice`.
#pragma once

#include "runtime/render/volume_light.hpp"

namespace voxelume {

/// Fills a volume, whose frame is set. Throws Error::limit where voxels have no room.
void render_lattice(VolumeWork& work, Volume& volume);

}  // namespace voxelume
