// SPDX-License-Identifier: Apache-2.0
// What follows from a scene's values alone.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// What rays see that leave the world.
struct Outside {
    glm::vec3 background;    ///< radiance, for all rays if there is no sky, or one that is hidden
    std::optional<Sky> sky;  ///< hidden from observers if it isn't visible
};

/// Where the image is transparent, observers see nothing there, and other rays what they see
/// otherwise: the background as a sky that lights nothing.
Outside outside_of(const Scene& scene);

/// One material per group of a mesh, or one in all for a mesh without groups. Throws Error::scene
/// when the object names a group that the mesh does not have.
std::vector<int> materials_of_groups(const Object& object,
                                     const std::vector<std::string>& group_names);

/// True if one of the object's materials has emission.
bool has_emission(const Scene& scene, const Object& object);

/// The rank of each object by descending priority; among equal priorities the earlier object comes
/// first.
std::vector<uint32_t> object_ranks(const std::vector<Object>& objects);

/// For each object, its index among those whose surfaces coincide, of which a ray meets the first:
/// opaque ones come before others, and each of these in the order of object_ranks. Empty for scenes
/// with fewer than two objects or without exact surfaces.
std::vector<uint32_t> coincidence_order(const Scene& scene);

/// True if light goes through or past surfaces of the material.
bool transmits(const Material& material);

/// True if a material that the object may show transmits light.
bool transmits(const Scene& scene, const Object& object);

/// True if an object's emission lights the world: the paper's source of many light samples.
bool is_emissive(const Scene& scene, const Object& object);

/// True if any light comes from it.
bool shines(const Light& light);

/// True if the medium between the objects scatters light. In local light none does.
bool has_scattering(const Scene& scene);

/// True if any light comes from a light that isn't infinitely far away.
bool has_placed_light(const Scene& scene);

/// True if it shines from an area, not from one point or direction.
bool has_area(const Light& light);

/// True if a light shines from an area.
bool has_area_light(const Scene& scene);

/// True if paths may count lights with an area that they run into. They don't where rays to lights
/// pass what paths don't pass: everything, without shadows, or objects whose materials transmit.
bool may_meet_lights(const Scene& scene);

/// True if rays see the voxels inside of the object, too: solid cubes that let light through.
bool shows_inside(const Scene& scene, const Object& object);

/// True if an object can be an instance: not cubes that let light through, nor what has no end.
bool can_be_instance(const Scene& scene, const Object& object);

/// True if rays are transformed into the object's space, instead of the object into the world's.
///
/// `auto` is `world` for an object that stands still, for one that can't be an instance, and for
/// one that lets light through: whether rays begin inside of an instance, only tracing tells.
bool is_instanced(const Scene& scene, const Object& object);

/// Throws Error::scene, saying why, for an object that is to be an `instance` and can't.
void check_placements(const Scene& scene);

/// Objects that transmit light of which no formula tells whether a ray begins inside: smooth ones,
/// exact meshes and instances.
struct HollowObjects {
    std::vector<uint32_t> flags;  ///< per object: 1 or 0
    uint32_t maximum = 0;         ///< that a ray may be in at once: the smooth ones of the world's
                                  ///< voxels count as one
};
HollowObjects hollow_objects(const Scene& scene);

}  // namespace voxelume
