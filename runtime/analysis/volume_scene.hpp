// SPDX-License-Identifier: Apache-2.0
// scene -> what its volumetric image shows of it.
#pragma once

#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// The scene with the default channels, since the channels that it asks for belong to the flat
/// image. In global light no medium scatters, because voxels of a medium hold only the medium's own
/// light.
Scene volume_scene(Scene scene);

/// True if volumetric images of the scene take samples until their noise is low enough.
bool is_sampled_by_noise(const RenderSettings& render);

/// The features of a scene that `volume_scene` returned.
Features volume_features(const Scene& scene, const Pyramid& world);

}  // namespace voxelume
