// SPDX-License-Identifier: Apache-2.0
// scene -> what its volumetric image shows of it.
#pragma once

#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// The scene with the default channels; what it asks for are a flat image's. In global light no
/// medium scatters, for the voxels of a medium have only its own light.
Scene volume_scene(Scene scene);

/// The same in local light where a display can't show global light: in the layout `rays` with
/// objects that let light through, whose layers need the light of each alone.
Scene volume_scene(const Scene& scene, const Pyramid& world);

/// The features of a scene that `volume_scene` gave.
Features volume_features(const Scene& scene, const Pyramid& world);

}  // namespace voxelume
