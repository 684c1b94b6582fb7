// SPDX-License-Identifier: Apache-2.0
// scene -> what its volumetric image shows of it.
#pragma once

#include "runtime/base/warning.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// The scene with the default channels, since the channels that it asks for belong to the flat
/// image. In global light no medium scatters, because voxels of a medium hold only the medium's own
/// light.
Scene volume_scene(Scene scene);

/// The scene, in local light where its display can't show global light: in the layout `rays`, each
/// layer of objects that let light through would need light of its own.
Scene volume_scene(const Scene& scene, const Pyramid& world);

/// True if volumetric images of the scene take samples until their noise is low enough.
bool is_sampled_by_noise(const RenderSettings& render);

/// True if the scene's objects rule out global light, wherever they are in a frame. In a world,
/// textures and voxels that are seen through may rule it out, too.
bool drops_global_light(const Scene& scene);

/// The warning for callers that ask for global light and get a volumetric image in local light.
Warning local_volume_warning(const Scene& scene);

/// The features of a scene that `volume_scene` returned.
Features volume_features(const Scene& scene, const Pyramid& world);

}  // namespace voxelume
