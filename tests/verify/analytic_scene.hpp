// SPDX-License-Identifier: Apache-2.0
// Scenes of analytic solids that tests assemble part by part.
#pragma once

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// An empty scene of 20 x 20 x 20 m around the origin, with deep recursion and by default a black
/// background.
inline Scene empty_scene(const glm::vec3& background = glm::vec3(0)) {
    Scene scene;
    scene.world.voxel_size = glm::dvec3(1);
    scene.world.bounds = {glm::dvec3(-10), glm::dvec3(10)};
    scene.world.voxels = glm::ivec3(20);
    scene.world.background = background;
    scene.materials.emplace_back();
    scene.render.depth = 8;
    scene.render.min_weight = 0;
    return scene;
}

inline Solid sphere_solid(double radius) {
    Solid solid;
    solid.radius = radius;
    return solid;
}

inline Solid slab_solid(double thickness) {
    Solid solid;
    solid.kind = SolidKind::slab;
    solid.thickness = thickness;
    return solid;
}

inline Solid box_solid(const glm::dvec3& size) {
    Solid solid;
    solid.kind = SolidKind::box;
    solid.size = size;
    return solid;
}

/// Adds an object with its own model and material; returns its index.
inline int add_object(Scene& scene, const Solid& solid, const Material& material,
                      const glm::dmat4& world_from_object = glm::dmat4(1), int priority = 0) {
    Model model;
    model.solid = solid;
    model.surface = Surface::exact;
    Object object;
    object.model = int(scene.models.size());
    object.material = int(scene.materials.size());
    object.priority = priority;
    object.world_from_object = world_from_object;
    scene.models.push_back(model);
    scene.materials.push_back(material);
    scene.objects.push_back(object);
    return int(scene.objects.size()) - 1;
}

/// Adds a box from corner to corner.
inline int add_box(Scene& scene, const glm::dvec3& low, const glm::dvec3& high,
                   const Material& material) {
    return add_object(scene, box_solid(high - low), material,
                      glm::translate(glm::dmat4(1), (low + high) / 2.0));
}

/// A material that emits light and reflects none.
inline Material emitter(const glm::vec3& radiance) {
    Material m;
    m.diffuse = 0;
    m.emission = radiance;
    return m;
}

/// A material that refracts light and does nothing else.
inline Material clear_glass(float ior) {
    Material m;
    m.diffuse = 0;
    m.refraction = 1;
    m.ior = ior;
    return m;
}

inline Light point_light(const glm::dvec3& position, const glm::vec3& intensity) {
    Light light;
    light.position = position;
    light.intensity = intensity;
    return light;
}

}  // namespace voxelume
