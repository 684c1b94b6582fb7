// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/culling.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "runtime/analysis/cube_steps.hpp"
#include "runtime/analysis/culling_hull.hpp"
#include "runtime/analysis/object_boxes.hpp"
#include "runtime/analysis/scene_choices.hpp"
#include "runtime/analysis/scene_features.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/scene_motion.hpp"
#include "runtime/scene/shutter.hpp"

namespace voxelume {
namespace {

/// The relative error of rays' coordinates in float: some hundred roundings.
constexpr double kRounding = 0x1p-17;

/// True if some channel of the image shows light, a part of it, or how much surfaces cover.
bool traces_light(const Scene& scene) {
    const ImageChannels& c = scene.render.channels;
    return c.color || c.albedo || c.direct || c.indirect || c.shadow || c.light_groups ||
           c.samples || c.noise || c.object_matte || c.material_matte;
}

/// True if maps may make parts of the object mirrors in local light.
bool is_mirror_by_maps(const Scene& scene, const Object& object) {
    const auto is_mirror = [&](int number) {
        return maps_make_mirrors(scene.materials[size_t(number)]);
    };
    return scene.render.depth > 0 &&
           (is_mirror(object.material) ||
            std::ranges::any_of(object.groups, is_mirror, &GroupMaterial::material));
}

/// True if rays go on through parts of the textures that the object's mesh wears, or from parts
/// that their maps make mirrors. A file that isn't read (`reads` is false) may have such textures.
bool textures_send_on(const Scene& scene, const Object& object, AssetStore& meshes, bool reads) {
    const Model& model = scene.models[size_t(object.model)];
    const bool mirrors = !shows_voxels(model.surface) && is_mirror_by_maps(scene, object);
    const bool shows_alpha = lists_primitives(model.surface);
    if (model.solid || !(mirrors || shows_alpha)) return false;
    if (!reads) return true;
    const MeshSummary* mesh = meshes.summary_of(model);
    return mesh && ((shows_alpha && mesh->paint.has_alpha) || (mirrors && mesh->paint.mapped > 0));
}

/// True if rays continue from surfaces of the object. Voxels in a file that isn't read (`reads` is
/// false) count as if rays continued from them.
bool sends_rays_on(const Scene& scene, const Object& object, AssetStore& meshes, bool reads) {
    if (!traces_light(scene)) return false;
    if (scene.render.light == LightMode::global && scene.render.bounces > 0) return true;
    // Rays to the sky and to points of the sun go in any direction.
    if (scene.render.shadows && (has_sky_samples(scene) || has_sun(scene.world))) return true;
    const Model& model = scene.models[size_t(object.model)];
    if (!model.voxels.empty() && (!reads || meshes.voxels(model).transparent)) return true;
    if (textures_send_on(scene, object, meshes, reads)) return true;
    const auto sends = [&](int number) {
        const Material& material = scene.materials[size_t(number)];
        return transmits(material) ||
               (scene.render.depth > 0 && (effects_of(material) & kReflects) != 0);
    };
    return sends(object.material) ||
           std::ranges::any_of(object.groups,
                               [&](const GroupMaterial& group) { return sends(group.material); });
}

/// The hull that no ray leaves, and the distance from it at which a box is culled.
class RayHull {
  public:
    RayHull(const Scene& scene, const std::vector<VoxelBox>& emissive_objects, double offset) {
        const GridFrame world = world_frame(scene.world);
        Observer observer = scene.observer;
        observer.display =
            with_filter_margin(observer.display, scene.render.filter, frame_size(scene.render));
        hull_ = hull_of_sight_rays(observer, world);
        if (scene.render.shadows && traces_light(scene))
            add_shadow_rays(scene, emissive_objects, world, hull_);
        const glm::dvec3 eye = (scene.observer.position - world.origin) / world.voxel_edge;
        double largest = 0;
        const auto include = [&](const glm::dvec3& p) {
            largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        };
        include(eye);
        for (const glm::dvec3& point : hull_) include(point);
        gap_ = 1 + offset + kRounding * largest;
    }

    bool meets(const VoxelBox& box) const {
        return !are_apart(hull_, {box.low - kInfluence, box.high + kInfluence}, gap_);
    }

  private:
    Hull hull_;
    double gap_ = 1;
};

/// True if an object may affect where an emissive object's surface lies, or is an emissive object.
bool is_near(const VoxelBox& box, const std::vector<VoxelBox>& emissive_objects) {
    const VoxelBox wide = {box.low - kInfluence, box.high + kInfluence};
    return std::ranges::any_of(emissive_objects, [&](const VoxelBox& emissive_object) {
        return overlap(wide, emissive_object);
    });
}

double longest_of(const glm::dvec3& edges) {
    return std::max({edges.x, edges.y, edges.z});
}

bool is_shown_instance(const Scene& scene, const Object& object) {
    return object.visible && is_instanced(scene, object);
}

/// The maximum factor by which an object's map stretches lengths, in world voxels per metre.
double voxels_per_metre(const Scene& scene, const Object& object) {
    const glm::dmat3 map(object.world_from_object);
    const double stretch =
        std::sqrt(glm::dot(map[0], map[0]) + glm::dot(map[1], map[1]) + glm::dot(map[2], map[2]));
    const glm::dvec3 edge = world_frame(scene.world).voxel_edge;
    return stretch / std::min({edge.x, edge.y, edge.z});
}

/// The origin offset of cubes with normals: rays begin at most |g|_max + |g|_1 above a face,
/// where g is a gradient of length 1, and that is below 2.75 voxels; where they are resampled, up
/// to |h|_1 of a gradient in their object's voxels higher.
double origin_offset_of_cubes(const Scene& scene, const Object& object, AssetStore& meshes,
                              bool reads) {
    constexpr double kMaxVoxels = 2.75, kMaxOwnVoxels = 1.75;
    const Model& model = scene.models[size_t(object.model)];
    if (is_instanced(scene, object)) {
        if (!model.voxels.empty() || model.voxel_size == glm::dvec3(0)) return INFINITY;
        return kMaxVoxels * longest_of(model.voxel_size) * voxels_per_metre(scene, object);
    }
    if (!reads) return INFINITY;
    const glm::dvec3 edge = world_frame(scene.world).voxel_edge;
    const double offset = kMaxVoxels * longest_of(edge) / std::min({edge.x, edge.y, edge.z});
    const std::optional<GridFrame> own = frame_of_resampled_cubes(scene, object, meshes);
    if (!own) return offset;
    return offset + kMaxOwnVoxels * longest_of(own->voxel_edge) * voxels_per_metre(scene, object);
}

/// The longest way, in voxels, from a surface of an object to where its rays to lights begin: the
/// shadow terminator's fix moves them by less than the longest edge of a triangle. A file that
/// isn't read (`reads` is false) may have triangles of any size.
double origin_offset(const Scene& scene, const Object& object, AssetStore& meshes, bool reads) {
    const Model& model = scene.models[size_t(object.model)];
    if (object.visible && gives_cubes_normals(model, meshes, reads))
        return origin_offset_of_cubes(scene, object, meshes, reads);
    if (!object.visible || !lists_primitives(model.surface) || model.solid) return 0;
    if (model.shading.kind == ShadingKind::flat) return 0;
    if (!reads) return INFINITY;
    const MeshSummary* mesh = meshes.summary_of(model);
    if (!mesh || !has_shading_normals(model.shading, mesh->has_normals)) return 0;
    return mesh->longest_edge * voxels_per_metre(scene, object);
}

/// The maximum origin offset of all objects. `unread` marks objects whose files aren't read.
double max_origin_offset(const Scene& scene, AssetStore& meshes, const std::vector<bool>& unread) {
    double offset = 0;
    if (scene.render.shadows && traces_light(scene))
        for (size_t i = 0; i < scene.objects.size(); ++i)
            offset = std::max(offset, origin_offset(scene, scene.objects[i], meshes, !unread[i]));
    return offset;
}

/// Marks the objects that rays may reach in one frame, in addition to those that earlier frames
/// marked. The boxes of objects that are marked already don't matter, unless they are emissive. The
/// `unread` ones, whose files aren't read, are among them.
void add_potentially_visible(Scene scene, AssetStore& meshes, const std::vector<bool>& unread,
                             std::vector<bool>& potentially_visible) {
    const std::vector<Object> objects = scene.objects;
    const double offset = max_origin_offset(scene, meshes, unread);
    const bool is_bounded = std::isfinite(offset);
    for (size_t i = 0; i < objects.size(); ++i)
        if (potentially_visible[i] && !is_emissive(scene, objects[i]))
            scene.objects[i].visible = false;
    const std::vector<VoxelBox> boxes = object_boxes(scene, meshes);

    std::vector<VoxelBox> emissive_objects;
    for (size_t i = 0; i < objects.size(); ++i)
        if (traces_light(scene) && is_emissive(scene, objects[i]) && !is_empty(boxes[i]))
            emissive_objects.push_back(boxes[i]);
    const RayHull hull(scene, emissive_objects, is_bounded ? offset : 0);
    std::vector<bool> met = potentially_visible;
    // A lens sees past the sides of the observer's pyramid.
    bool all = scene.observer.display.layout == VolumeLayout::lattice || !is_bounded ||
               scene.observer.aperture > 0 || (traces_light(scene) && has_scattering(scene));
    for (size_t i = 0; i < objects.size(); ++i) {
        if (!met[i])
            met[i] = !is_empty(boxes[i]) &&
                     (is_near(boxes[i], emissive_objects) || hull.meets(boxes[i]));
        all = all || (met[i] && objects[i].visible &&
                      sends_rays_on(scene, objects[i], meshes, !potentially_visible[i]));
    }
    bool instances = false;
    for (size_t i = 0; i < objects.size(); ++i) {
        potentially_visible[i] = met[i] || (all && !is_empty(boxes[i]));
        instances = instances || (potentially_visible[i] && is_shown_instance(scene, objects[i]));
    }
    // Rays leave instances from a height that all instances decide, also those outside of the
    // world.
    for (size_t i = 0; i < objects.size(); ++i)
        potentially_visible[i] =
            potentially_visible[i] || (instances && is_shown_instance(scene, objects[i]));
}

/// Above this number of moments, all objects count as potentially visible: looking at each moment
/// would take as long as rendering.
constexpr size_t kMaxSeenMoments = 1 << 16;

/// True for each object whose model changes. Such models may have many files, which aren't read
/// before their frames.
std::vector<bool> objects_of_moving_models(const Scene& scene) {
    std::vector<bool> found(scene.objects.size());
    if (!moves(scene)) return found;
    for (const MovingPart& part : scene.motion->parts)
        for (size_t i = 0; i < found.size(); ++i)
            found[i] = found[i] || (part.part == ScenePart::model &&
                                    size_t(scene.objects[i].model) == part.index);
    return found;
}

}  // namespace

void find_potentially_visible(Scene& scene, std::span<const int> frames, AssetStore& meshes) {
    const bool are_many = frames.size() > 1 || has_moments(scene);
    const std::vector<bool> unread =
        are_many ? objects_of_moving_models(scene) : std::vector<bool>(scene.objects.size());
    std::vector<bool> potentially_visible = unread;
    size_t moments = 0;
    for (const int frame : frames) moments += moments_of(scene, frame).size();
    if (has_moments(scene) && moments > kMaxSeenMoments) return;
    std::optional<Scene> before;
    for (const int frame : frames)
        for (const double moment : moments_of(scene, frame)) {
            if (std::ranges::find(potentially_visible, false) == potentially_visible.end()) return;
            in_frame(scene, moment, [&] {
                Scene now = scene_at(scene, moment);
                if (before == now) return;
                add_potentially_visible(now, meshes, unread, potentially_visible);
                before = std::move(now);
            });
        }
    for (size_t i = 0; i < potentially_visible.size(); ++i)
        scene.objects[i].potentially_visible = potentially_visible[i];
}

void leave_out_culled(const Scene& scene, Pyramid& world) {
    const auto has = [&](bool (*is_stored)(Surface)) {
        return std::ranges::any_of(scene.objects, [&](const Object& object) {
            const Model& model = scene.models[size_t(object.model)];
            const std::optional<Model> part = thin_part_of(model);
            return is_potentially_visible(scene, object) && !is_instanced(scene, object) &&
                   (is_stored(model.surface) || (part && is_stored(part->surface)));
        });
    };
    if (!has(stores_distances)) world.fields = {};
    if (has(lists_primitives)) return;
    world.primitive_first = world.primitives = world.triangle_attributes = world.solids = {};
    world.triangle_normals = world.triangle_textures = world.textures = {};
    world.triangles = {};
}

Scene with_culling(Scene scene, AssetStore& meshes) {
    make_choices(scene, meshes);
    std::vector<bool> potentially_visible(scene.objects.size());
    const std::vector<bool> unread = potentially_visible;
    add_potentially_visible(scene, meshes, unread, potentially_visible);
    for (size_t i = 0; i < potentially_visible.size(); ++i)
        scene.objects[i].potentially_visible = potentially_visible[i];
    return scene;
}

}  // namespace voxelume
