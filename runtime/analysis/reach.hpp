// frames of a scene -> the objects that some ray may reach in one of them.
#pragma once

#include <span>

#include "runtime/assets/mesh_store.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Sets Object::in_reach of all objects for a run of these `frames`. What is out of reach isn't
/// voxelized, and no picture or volume that the observer sees of the frames has other bits for it.
///
/// In a frame where nothing in reach reflects or lets light through, rays stay within the convex
/// hull of what the display sees of the world and, with shadows, of the lights; an object is out of
/// reach if a plane parts its box from that. In other frames, and where the display is a lattice,
/// every object in the world is in reach. Lamps always are, with what may cover part of one. For
/// images without colour only sight rays count.
/// Instances are in reach together, also those outside of the world.
///
/// Reads the files of the objects' models whose bounds the store doesn't know, but of several
/// frames not those that change. Throws as MeshStore and scene_at do, with the frame.
void find_objects_in_reach(Scene& scene, std::span<const int> frames, MeshStore& meshes);

/// Takes from a world of more objects the surfaces of kinds that nothing in reach has.
void leave_out_of_reach(const Scene& scene, Pyramid& world);

/// The scene, whose frame it is, with the objects in reach found for this picture alone.
Scene with_objects_in_reach(Scene scene, MeshStore& meshes);

}  // namespace voxelume
