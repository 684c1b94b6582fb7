// SPDX-License-Identifier: Apache-2.0
#include "runtime/world/world_source.hpp"

#include <algorithm>

#include "runtime/analysis/object_lattice.hpp"
#include "runtime/analysis/placed_objects.hpp"
#include "runtime/base/files/cache_key.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/scene_motion.hpp"

namespace voxelume {
namespace {

void add_frame(CacheKey& words, const GridFrame& frame) {
    words.add_all(frame.origin).add_all(frame.voxel_edge).add_all(frame.size);
}

void add_solid(CacheKey& words, const Solid& solid) {
    words.add(int(solid.kind)).add(solid.radius).add(solid.top_radius).add(solid.tube);
    words.add(solid.height).add(solid.thickness).add_all(solid.radii).add_all(solid.size);
    words.add_columns(solid.parent_from_solid).add(solid.parts.size());
    for (const Solid& part : solid.parts) add_solid(words, part);
}

/// A hash of a model's files; empty for a solid, and for files whose worlds aren't kept.
std::string source_of_files(const Model& model, AssetStore& meshes) {
    return model.voxels.empty() ? meshes.source_of(model) : meshes.source_of_voxels(model);
}

void add_model(CacheKey& words, const Model& model, AssetStore& meshes) {
    words.add_text(source_of_files(model, meshes)).add(int(model.surface)).add(int(model.set));
    words.add(int(model.shading.kind)).add(model.shading.crease_angle);
    words.add(int(model.normals)).add(model.thin_edge);
    words.add(model.cuts.size());
    for (const Solid& cut : model.cuts) add_solid(words, cut);
    if (model.solid) add_solid(words, *model.solid);
}

bool is_placed(const Scene& scene, const Object& object) {
    return !is_instanced(scene, object);
}

/// True if objects in the world's voxels, or their models, change. Lights, observers, the
/// environment and instances don't change the world's voxels; materials only change which voxels
/// are visible inside.
bool world_moves(const Scene& scene) {
    return any_part_changes(scene, [&](const MovingPart& part) {
        if (part.part == ScenePart::object) return is_placed(scene, scene.objects[part.index]);
        return part.part == ScenePart::model &&
               std::ranges::any_of(scene.objects, [&](const Object& object) {
                   return size_t(object.model) == part.index && is_placed(scene, object);
               });
    });
}

}  // namespace

std::string world_source(const Scene& scene, AssetStore& meshes) {
    if (!meshes.cache().keeps_worlds() || world_moves(scene)) return {};
    CacheKey words;
    const GridFrame world = world_frame(scene.world);
    add_frame(words, world);
    ObjectLattices lattices(scene, meshes);
    for (uint32_t number = 0; number < scene.objects.size(); ++number) {
        const Object& object = scene.objects[number];
        if (is_instanced(scene, object) || !is_potentially_visible(scene, object)) continue;
        const Model& model = scene.models[size_t(object.model)];
        if (!model.voxels.empty() && source_of_files(model, meshes).empty()) return {};
        words.add(number).add(object.priority).add(keeps_inside(scene, object, model));
        words.add_columns(object.world_from_object);
        // Grids on the world's own lattice depend on their map alone.
        const Lattice lattice = lattices.lattice_of(object);
        words.add(int(lattice));
        if (lattice != Lattice::world) add_frame(words, lattices.own_frame(object));
        for (const int material : materials_of_groups(object, meshes.groups_of(model)))
            words.add(material);
        add_model(words, model, meshes);
    }
    return world_key(words.bytes());
}

std::vector<std::string> world_sources(const Scene& scene, AssetStore& meshes) {
    std::vector<std::string> sources = {world_source(scene, meshes)};
    if (sources[0].empty()) return {};
    Scene whole = scene;
    for (Object& object : whole.objects) object.potentially_visible = true;
    if (whole == scene) return sources;
    if (std::string source = world_source(whole, meshes); !source.empty())
        sources.push_back(std::move(source));
    return sources;
}

}  // namespace voxelume
