// SPDX-License-Identifier: Apache-2.0
// emissive voxels -> a table by which light paths choose an emitter, and look up one that they met.
#pragma once

#include <cstdint>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/emitter_table.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// The maximum number of emitters. If there are more voxels, the brightest are listed; a hash
/// decides between equal ones, so that they lie all over the scene. Paths find the others by
/// running into them.
inline constexpr size_t kMaxEmitters = size_t{1} << 20;

/// The share of rays to light that go to emitters if other rays go to a sky.
inline constexpr float kEmitterChanceWithSky = 0.5f;

/// The main memory for listing `voxels` voxels of sources that have `listed` in all.
double emitter_host_bytes(size_t voxels, size_t listed);

/// The value of VXL_EMITTERS that a scene's settings ask for, if it has emissive objects.
int emitter_feature(const RenderSettings& render);

/// Lists the voxels of all objects that emit light and have light samples, in the world and in
/// instances. A voxel's probability is proportional to the luminance of its emission and to the
/// area of its open sides, or of one side if it holds no cube. The table is equal on every device.
/// Throws Error::limit if the device's memory doesn't suffice.
EmitterTable build_emitters(const Device& device, const Features& features, const Scene& scene,
                            const Pyramid& world);

}  // namespace voxelume
