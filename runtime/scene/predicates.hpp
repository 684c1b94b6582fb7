// SPDX-License-Identifier: Apache-2.0
// Properties that follow from a scene's values alone.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The environment that rays see where they leave the world.
struct Outside {
    glm::vec3 background;    ///< radiance, for all rays if there is no sky, or one that is hidden
    std::optional<Sky> sky;  ///< hidden from observers if it isn't visible
};

/// The environment of a scene. If the image is transparent, observers see nothing there, and other
/// rays see their usual environment: the background as a sky that lights nothing.
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

/// For each object, its index in the order in which coinciding surfaces hide each other: a ray
/// meets the first one. Opaque objects come before others, and each group is in the order of
/// object_ranks. Empty for scenes with fewer than two objects or without exact surfaces.
std::vector<uint32_t> coincidence_order(const Scene& scene);

/// True if light goes through or past surfaces of the material.
bool transmits(const Material& material);

/// True if a material that the object may show transmits light.
bool transmits(const Scene& scene, const Object& object);

/// True if an object's emission lights the world: the paper's source of many light samples.
bool is_emissive(const Scene& scene, const Object& object);

/// True if any light comes from the light.
bool shines(const Light& light);

/// True if the medium between the objects scatters light. In local light none does.
bool has_scattering(const Scene& scene);

/// True if any light comes from a light that isn't infinitely far away.
bool has_placed_light(const Scene& scene);

/// True if the light shines from an area, not from one point or direction.
bool has_area(const Light& light);

/// True if a light shines from an area.
bool has_area_light(const Scene& scene);

/// True if paths may count area lights that they run into. They may not where rays to lights pass
/// objects that block paths: all objects, without shadows, or objects whose materials transmit.
bool may_meet_lights(const Scene& scene);

/// True if rays see the voxels inside of the object, too: solid cubes that let light through.
bool shows_inside(const Scene& scene, const Object& object);

/// True if an object can be an instance: not cubes that let light through, nor an infinite solid.
bool can_be_instance(const Scene& scene, const Object& object);

/// True if rays are transformed into the object's space, instead of the object into the world's.
///
/// `auto` is `world` for an object that stands still, for one that can't be an instance, and for
/// one that lets light through, because only tracing can tell whether rays begin inside of an
/// instance.
bool is_instanced(const Scene& scene, const Object& object);

/// Throws Error::scene, with the reason, for an object that is set to `instance` and can't be one.
void check_placements(const Scene& scene);

/// Objects that transmit light and for which no formula tells whether a ray begins inside: smooth
/// ones, exact meshes and instances.
struct HollowObjects {
    std::vector<uint32_t> flags;  ///< per object: 1 or 0
    uint32_t maximum = 0;  ///< maximum number that a ray may be in at once; smooth objects of the
                           ///< world count as one voxels count as one
};
HollowObjects hollow_objects(const Scene& scene);

}  // namespace voxelume
