// SPDX-License-Identifier: Apache-2.0
// frames of a scene -> the objects that some ray may reach in one of them
#pragma once

#include <span>

#include "runtime/assets/asset_store.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Sets Object::potentially_visible of all objects for a run of these `frames`, with the moments
/// that their samples show. With more than 65,536 moments, all objects count as potentially
/// visible. A culled object isn't voxelized. Culling changes no bit of a picture or volume that the
/// observer sees in these frames.
///
/// In a frame where nothing potentially visible reflects or lets light through, rays stay within
/// the convex hull of what the display sees of the world and, with shadows, of the lights. An
/// object is culled if a plane separates its box from that hull. In other frames, and where the
/// display is a lattice, every object in the world is potentially visible. Emissive objects always
/// are, and so is everything that may cover part of one. For images without colour only sight rays
/// count. Instances are potentially visible together, also those outside of the world.
///
/// Reads the files of the objects' models whose bounds the store doesn't know. For several frames
/// it doesn't read those of models that change. Throws as AssetStore and scene_at do, with the
/// frame.
void find_potentially_visible(Scene& scene, std::span<const int> frames, AssetStore& meshes);

/// Removes, from a world of more objects, the surfaces of kinds that nothing potentially visible
/// has.
void leave_out_culled(const Scene& scene, Pyramid& world);

/// The scene of one frame, with its choices made and Object::potentially_visible set for this
/// picture alone.
Scene with_culling(Scene scene, AssetStore& meshes);

}  // namespace voxelume
