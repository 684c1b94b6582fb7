// SPDX-License-Identifier: Apache-2.0
// scene -> what its volumetric image shows of it.
#pragma once

#include "runtime/base/warning.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// The scene with the default channels; what it asks for are a flat image's. In global light no
/// medium scatters, for the voxels of a medium have only its own light, and with a noise to reach
/// all voxels have a few samples: none is measured.
Scene volume_scene(Scene scene);

/// Where a display can't show global light, the scene is in local light: in the layout `rays` the
/// layers of objects that let light through would need the light of each alone.
Scene volume_scene(const Scene& scene, const Pyramid& world);

/// True if the scene's objects rule out global light, wherever they are in a frame. In a world,
/// textures and voxels that are seen through may rule it out, too.
bool drops_global_light(const Scene& scene);

/// What the caller of an image that drops it is told.
Warning local_volume_warning(const Scene& scene);

/// The features of a scene that `volume_scene` gave.
Features volume_features(const Scene& scene, const Pyramid& world);

}  // namespace voxelume
