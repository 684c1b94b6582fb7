// SPDX-License-Identifier: Apache-2.0
// Meshes that morphs, targets and skins move.
#include <cmath>

#include "runtime/assets/asset_store.hpp"
#include "runtime/assets/load_timer.hpp"
#include "runtime/base/error.hpp"
#include "runtime/geometry/file_map.hpp"
#include "runtime/geometry/mesh_morph.hpp"
#include "runtime/io/gltf/gltf_targets.hpp"

namespace voxelume {

AssetStore::Morphed& AssetStore::morphed(const Model& model) {
    used_.insert({model.mesh, model.morph->mesh});
    used_morphs_.insert(model.name);
    const auto found = morphed_.find(model.name);
    if (found != morphed_.end() && found->second.file == model.mesh &&
        found->second.map == model.object_from_file && found->second.morph == *model.morph)
        return found->second;
    Morphed fresh{model.mesh, model.object_from_file, *model.morph, {}, {}};
    return morphed_.insert_or_assign(model.name, std::move(fresh)).first->second;
}

const Mesh& AssetStore::morphed_mesh(const Model& model) {
    Morphed& entry = morphed(model);
    if (entry.mesh) return *entry.mesh;
    const Morph& morph = *model.morph;
    const FileMap& map = model.object_from_file;
    if (morph.is_of_file()) return entry.mesh.emplace(mesh_moved_by_file(model));
    const Mesh& from = mesh(model.mesh, map, model.part);
    entry.mesh = morph.mesh.empty()
                     ? morphed_to_sphere(from, morph.center, morph.radius, morph.amount)
                     : ::voxelume::morphed(from, mesh(morph.mesh, map), morph.amount, model.where);
    return *entry.mesh;
}

const std::vector<MorphTarget>& AssetStore::targets_of(const Model& model) {
    std::optional<std::vector<MorphTarget>>& targets = file({model.mesh, model.part}).targets;
    if (!targets) {
        const LoadTimer timer(load_seconds_);
        targets = gltf_targets(gltf_file(model.mesh), model.part);
    }
    if (model.morph->weights.size() > targets->size())
        throw Error(ErrorKind::input, "{}: has {} weights, and its mesh has {} targets",
                    model.where, model.morph->weights.size(), targets->size());
    return *targets;
}

const GltfSkin& AssetStore::skin_of(const Model& model) {
    const Morph& morph = *model.morph;
    auto& skin = file({model.mesh, model.part}).skins[{morph.skin, morph.clip}];
    if (!skin) {
        const LoadTimer timer(load_seconds_);
        skin = std::make_shared<const GltfSkin>(gltf_file(model.mesh), model.part, morph.skin - 1,
                                                morph.clip);
    }
    return *skin;
}

/// Targets pull before a skin moves what they have made.
Mesh AssetStore::mesh_moved_by_file(const Model& model) {
    const Morph& morph = *model.morph;
    const FileMap& map = model.object_from_file;
    const std::vector<MorphTarget> none;
    const std::vector<MorphTarget>& targets = morph.weights.empty() ? none : targets_of(model);
    if (morph.skin == 0)
        return moved_by_targets(mesh(model.mesh, map, model.part), targets, morph.weights,
                                map.scale);
    Mesh moved = moved_by_targets(mesh(model.mesh, {}, model.part), targets, morph.weights, 1);
    skin_of(model).move(moved, 0, morph.time);
    for (const glm::vec3& p : moved.positions)
        if (!std::isfinite(p.x + p.y + p.z))
            throw Error(ErrorKind::input, "{}: its skin moves a vertex to where none can be",
                        SourcePlace(model.mesh.string()));
    if (!map.is_identity()) apply(map, model.mesh, moved);
    return moved;
}

/// The box that a mesh in `box` has after that, in the file's own coordinates.
Bounds AssetStore::box_moved_by_file(const Model& model, const Bounds& box) {
    const Morph& morph = *model.morph;
    const auto reach = [&](const Bounds& from) {
        if (morph.weights.empty()) return from;
        return box_of_targets(from, targets_of(model), morph.weights);
    };
    if (morph.skin == 0) return reach(box);
    return skin_of(model).box_at(morph.time, reach({glm::dvec3(0), glm::dvec3(0)}));
}

}  // namespace voxelume
