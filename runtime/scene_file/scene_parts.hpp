// SPDX-License-Identifier: Apache-2.0
// The readers of the scene's parts, one per subject. Each takes the value of its key and throws
// Error::scene.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runtime/scene/parts/light.hpp"
#include "runtime/scene/parts/observer.hpp"
#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/scene_file/assets.hpp"
#include "runtime/scene_file/document/scene_fields.hpp"

namespace voxelume {

/// Names that other parts of the scene refer to, with their indices.
class NameTable {
  public:
    /// `kind` is the word for the named parts in messages: "material".
    explicit NameTable(std::string kind) : kind_(std::move(kind)) {}

    void add(const std::string& name) { indices_.emplace(name, static_cast<int>(indices_.size())); }
    /// Index of the name in the value. Throws Error::scene with the nearest name if there is none.
    int find(const SceneValue& value) const;

  private:
    std::string kind_;
    std::unordered_map<std::string, int> indices_;
};

/// The search for the files that a part of the scene names.
struct AssetSearch {
    std::filesystem::path scene_folder;
    const AssetFolders& assets;
    bool all_files = true;               ///< all files of a sequence must exist, not only the first
    const GivenVoxels* given = nullptr;  ///< voxels that take precedence over files; null: none
};

/// The search for models' files, and the voxel size that models take from the world, which is 0 if
/// it isn't known yet.
struct ModelContext {
    AssetSearch search;
    glm::dvec3 world_voxel_size;
};

/// Reads objects with the models and materials of a scene, which must be read before.
class ObjectReader {
  public:
    explicit ObjectReader(const Scene& scene);
    /// `number` is the object's index in the list. Doesn't compare its name with others.
    Object read(const SceneValue& value, size_t number) const;

  private:
    const Scene& scene_;
    NameTable models_{"model"};
    NameTable materials_{"material"};
};

/// Reads the world. If bounds or a voxel size are left out, they stay 0.
World read_world(const SceneValue& value, const AssetSearch& search);
Sky read_sky(const SceneValue& value, const AssetSearch& search);
Medium read_medium(const SceneValue& value, const AssetSearch& search);
Material read_material(const std::string& name, const SceneValue& value);
std::vector<Material> read_materials(const SceneValue& value);
Model read_model(const std::string& name, const SceneValue& value, const ModelContext& context);
std::vector<Model> read_models(const SceneValue& value, const ModelContext& context);
Solid read_solid(const SceneValue& value);  ///< of a model; see scene_solids.cpp for its parts
std::vector<Solid> read_cuts(const SceneValue& value);  ///< a list of parts, of a mesh
std::vector<Object> read_objects(const SceneValue& value, const Scene& scene);
LightParameters read_light_parameters(const SceneValue& value);
Light read_light(const SceneValue& value, size_t number);  ///< `number`: its index in the list
std::vector<Light> read_lights(const SceneValue& value);
ObserverParameters read_observer_parameters(const SceneValue& value);
Observer read_observer(const SceneValue& value, const Scene& scene);
Animation read_animation(const SceneValue& value);
RenderSettings read_render(const SceneValue& value);

/// Reads `position`, `turn` and `scale`.
Factors read_factors(const SceneFields& fields);

/// The map that `position`, `turn` and `scale`, or `matrix`, give. Refuses singular ones.
glm::dmat4 read_placement(const SceneFields& fields);

/// The maps of an object's `parents`, the outermost first, and its own.
std::vector<glm::dmat4> read_links(const SceneFields& object);

/// The product of the maps of read_links(). Refuses a singular map.
glm::dmat4 read_object_place(const SceneFields& object);

}  // namespace voxelume
