// SPDX-License-Identifier: Apache-2.0
// scene -> what is traced to learn how much its surfaces cover, for the voxels of lattice displays.
#pragma once

#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// The scene with the same surfaces but without light: it only tells how much they cover.
Scene unlit_scene(Scene scene);

/// The features with which rays from anywhere learn what an unlit scene's surfaces cover, even if
/// none of them lets light through. Refracting surfaces cover everything behind them.
Features coverage_features(const Scene& unlit, const Pyramid& world);

}  // namespace voxelume
