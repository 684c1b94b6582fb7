// SPDX-License-Identifier: Apache-2.0
// scene and world -> P in the layout `lattice`.
#pragma once

#include "runtime/image/volume.hpp"
#include "runtime/render/illumination.hpp"
#include "runtime/render/renderer.hpp"

namespace voxelume {

/// The data that both layouts work with.
struct VolumeWork {
    const Device& device;
    const Scene& scene;
    const Pyramid& world;
    Features features;
    VolumeFrame frame;
    Camera camera;
    RenderReport& report;
    const FrameProgress& progress;
};

/// The numbers of the rays that illumination has sent.
void count_rays(const Illumination& illumination, RenderReport& report);

/// Fills a volume, whose frame is set. Throws Error::limit where voxels have no room.
void render_lattice(VolumeWork& work, Volume& volume);

}  // namespace voxelume
