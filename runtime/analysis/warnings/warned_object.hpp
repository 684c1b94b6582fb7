// SPDX-License-Identifier: Apache-2.0
// An object as the world shows it, for what is said of it.
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>
#include <string>

#include "runtime/assets/asset_store.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

inline double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}
inline double smallest(const glm::dvec3& v) {
    return std::min({v.x, v.y, v.z});
}

/// The relative difference that rounding may cause between sizes that are meant to be equal: turned
/// maps and a "resolution" round their sizes.
inline constexpr double kSizeRounding = 1e-9;

/// A model as an object places it. Lengths are metres.
struct PlacedModel {
    const Model& model;
    bool is_instance = false;
    bool is_empty = false;  ///< nothing of its solid is left within the world ...
    bool is_void = false;   ///< ... or anywhere
    Bounds own{};           ///< box in object space
    Bounds world{};         ///< box in the world
    glm::dvec3 scale{1};    ///< factors by which lengths along the axes of object space grow
    glm::dvec3 voxel{0};    ///< edges of its voxels, in the world
};

/// The object's model as it is placed. Throws as AssetStore does.
PlacedModel placed(const Scene& scene, const Object& object, AssetStore& meshes);

/// How sentences name an object: by its name in quotes, or as "the object" if it has none.
std::string title_of(const Object& object);

}  // namespace voxelume
