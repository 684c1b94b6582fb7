// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/scene_choices.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/analysis/dense_meshes.hpp"
#include "runtime/analysis/object_lattice.hpp"
#include "runtime/assets/model_frame.hpp"
#include "runtime/base/text.hpp"
#include "runtime/geometry/solid/solid_bounds.hpp"
#include "runtime/scene/moved_part.hpp"
#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/scene_motion.hpp"

namespace voxelume {
namespace {

double longest(const glm::dvec3& edges) {
    return std::max({edges.x, edges.y, edges.z});
}

/// The edge, in metres of the model's space, of the largest voxels that would hold its distances.
double largest_voxel(const Scene& scene, size_t number, AssetStore& meshes) {
    const Model& model = scene.models[number];
    const double own = longest(model_frame(model, meshes.summary_of(model)).voxel_edge);
    double largest = 0;
    for (const Object& object : scene.objects) {
        if (size_t(object.model) != number) continue;
        const double scale = stretch_of(glm::dmat3(object.world_from_object)).min;
        const double world = longest(scene.world.voxel_size) / scale;
        const double placed = model.is_sized ? std::max(own, world) : world;
        largest = std::max(largest, is_instanced(scene, object) ? own : placed);
    }
    return largest > 0 ? largest : own;
}

/// True if light neither goes through an object nor comes from it.
bool is_plain(const Scene& scene, const Object& object) {
    return !transmits(scene, object) && !has_emission(scene, object);
}

/// True if the model, one of its objects or a material may change from frame to frame.
bool may_change(const Scene& scene, size_t number) {
    return any_part_changes(scene, [&](const MovingPart& part) {
        return part.part == ScenePart::material ||
               (part.part == ScenePart::model && part.index == number) ||
               (part.part == ScenePart::object &&
                size_t(scene.objects[part.index].model) == number);
    });
}

/// True if all of an object's mesh lies in the world.
bool is_within_world(const Scene& scene, const Object& object, const MeshSummary& mesh) {
    const Bounds world = lattice_bounds(scene.world);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p(object.world_from_object * glm::dvec4(corner(mesh.surface, i), 1));
        if (glm::any(glm::lessThan(p, world.min)) || glm::any(glm::greaterThan(p, world.max)))
            return false;
    }
    return true;
}

/// The reason why a mesh can't be smooth in one part and exact in another, overlapping part; empty
/// if it can. Only opaque surfaces that don't shine and are seen from outside alone hide the
/// overlap.
std::string refusal_of_parts(const Scene& scene, size_t number, const MeshSummary& mesh) {
    if (std::string refusal = voxelume::refusal_of_parts(mesh); !refusal.empty()) return refusal;
    if (scene.models[number].morph || may_change(scene, number)) return "it changes or moves";
    if (scene.observer.display.visibility == Visibility::all)
        return "the display shows what lies inside";
    for (const Object& object : scene.objects) {
        if (size_t(object.model) != number) continue;
        if (!is_plain(scene, object)) return "light goes through it or comes from it";
        if (!is_within_world(scene, object, mesh)) return "it reaches out of the world";
    }
    return {};
}

/// Chooses the surface of a mesh, and whether parts of it are exact.
SurfaceChoice chosen_for_mesh(const Scene& scene, size_t number, AssetStore& meshes) {
    Model file = scene.models[number];
    file.morph.reset();
    const MeshSummary& mesh = *meshes.summary_of(file);
    file.surface = Surface::smooth;
    file.thin_edge = largest_voxel(scene, number, meshes);
    SurfaceChoice choice = surface_for(mesh, meshes.shape_of(file), file.thin_edge);
    if (!choice.may_be_thin) return choice;
    return surface_with(choice, mesh, *meshes.summary_of(*thin_part_of(file)),
                        refusal_of_parts(scene, number, mesh));
}

/// True for a mesh of points and lines, of which nothing but cubes can be shown.
bool shows_points_alone(Model model, AssetStore& meshes) {
    model.morph.reset();
    return !model.mesh.empty() && !has_area(*meshes.summary_of(model));
}

void refuse_surface_of_points(const Scene& scene, size_t number) {
    const Model& model = scene.models[number];
    throw Error(ErrorKind::scene,
                "{}: {} has points and lines alone, which have no {} surface: give it "
                "\"surface\": \"cubes\"",
                model.where, quote(model.mesh.filename().string()), kind_of(model.surface).name);
}

SurfaceChoice chosen_surface(const Scene& scene, size_t number, AssetStore& meshes) {
    const Model& model = scene.models[number];
    if (!model.voxels.empty()) return meshes.surface_of_voxels(model);
    if (shows_points_alone(model, meshes)) return surface_for(*meshes.summary_of(model), {}, 0);
    if (!model.cuts.empty()) return {Surface::smooth, "it is cut"};
    if (model.shading != Shading()) return {Surface::exact, "the scene says its shading"};
    return chosen_for_mesh(scene, number, meshes);
}

void choose_surfaces(Scene& scene, AssetStore& meshes) {
    const bool may_appear = moves(scene);
    for (size_t number = 0; number < scene.models.size(); ++number) {
        Model& model = scene.models[number];
        const bool is_shown = std::ranges::any_of(scene.objects, [&](const Object& object) {
            return object.visible && size_t(object.model) == number;
        });
        if (!model.surface_reason.empty() || (!is_shown && !may_appear)) continue;
        if (!model.is_surface_open) {
            if (!shows_voxels(model.surface) && shows_points_alone(model, meshes))
                refuse_surface_of_points(scene, number);
            continue;
        }
        const SurfaceChoice choice = chosen_surface(scene, number, meshes);
        model.surface = choice.surface;
        model.surface_reason = choice.reason;
        if (choice.may_be_thin) model.thin_edge = largest_voxel(scene, number, meshes);
    }
}

/// True if the model's file has cubes that rays go through.
bool has_clear_cubes(const Model& model, AssetStore& meshes) {
    return !model.voxels.empty() && shows_voxels(model.surface) && meshes.voxels(model).transparent;
}

/// True for cubes with surface normals that are coarser than the world's voxels. In the world each
/// cube would become several voxels, with steps too high for rays to lights to begin above them.
bool is_coarser_soft_cubes(const Scene& scene, const Object& object, AssetStore& meshes) {
    const Model& model = scene.models[size_t(object.model)];
    if (!shows_voxels(model.surface) || model.normals != CubeNormals::surface ||
        !model.voxels.empty())
        return false;
    const double own = longest(model_frame(model, meshes.summary_of(model)).voxel_edge) *
                       stretch_of(glm::dmat3(object.world_from_object)).max;
    constexpr double kCoarser = 1.01;  // sizes that scenes fit have four digits
    return own > kCoarser * longest(scene.world.voxel_size);
}

/// True for a plain object in the world that becomes an instance because its mesh has many
/// triangles per voxel.
bool is_dense(const Scene& scene, const Object& object, AssetStore& meshes) {
    return is_plain(scene, object) && is_better_divided(scene, object, meshes) &&
           is_within_world(scene, object, *meshes.summary_of(scene.models[size_t(object.model)]));
}

/// The number of copies of a mesh from which they become instances: in the world, each copy would
/// be voxelized again. The pictures differ in rounding alone. A first frame takes less time and
/// memory, except for meshes of a few triangles, which take as long.
constexpr uint32_t kInstancedCopies = 8;

/// For each model, the number of plain objects that show it as a mesh that is wholly or partly
/// `exact`. All numbers are 0 if the world has cubes, which hide what shares their voxels.
std::vector<uint32_t> count_copies(const Scene& scene) {
    std::vector<uint32_t> copies(scene.models.size());
    for (const Object& object : scene.objects) {
        const Model& model = scene.models[size_t(object.model)];
        if (!object.visible) continue;
        if (shows_voxels(model.surface)) return std::vector<uint32_t>(scene.models.size());
        copies[size_t(object.model)] += !model.mesh.empty() && is_plain(scene, object) &&
                                        (lists_primitives(model.surface) || thin_part_of(model));
    }
    return copies;
}

void choose_placements(Scene& scene, AssetStore& meshes) {
    const bool may_appear = moves(scene);
    const std::vector<uint32_t> copies = count_copies(scene);
    bool has_changed = false;
    for (Object& object : scene.objects) {
        if (object.placement == Placement::automatic && is_instanced(scene, object) &&
            (object.visible || may_appear) &&
            has_clear_cubes(scene.models[size_t(object.model)], meshes)) {
            object.placement = Placement::world;
            has_changed = true;
        }
        const bool is_open = object.placement == Placement::automatic &&
                             !is_instanced(scene, object) && (object.visible || may_appear);
        if (!is_open || !can_be_instance(scene, object) ||
            (!is_finer_field(scene, object, meshes) &&
             !is_coarser_soft_cubes(scene, object, meshes) &&
             (copies[size_t(object.model)] < kInstancedCopies || !is_plain(scene, object)) &&
             (copies[size_t(object.model)] == 0 || !is_dense(scene, object, meshes))))
            continue;
        object.placement = Placement::instance;
        has_changed = true;
    }
    if (has_changed) find_extents(scene);
}

/// The sides of a model in its own space, metres. An instance is whole, also beyond the world.
glm::dvec3 sides_of(const Model& model, AssetStore& meshes) {
    if (!model.solid) {
        const Bounds& box = meshes.summary_of(model)->surface;
        return box.max - box.min;
    }
    const SolidBounds box = bounds(*model.solid, glm::dmat4(1));
    return box.is_empty() ? glm::dvec3(0) : box.max - box.min;
}

/// For each model, the factor by which its largest instance is larger than the model along each
/// axis, at least 1, in steps. Where frames move objects, some frames are looked at, spread over
/// all.
class LargestScales {
  public:
    explicit LargestScales(const Scene& scene)
        : scales_(scene.models.size(), glm::dvec3(1)), may_appear_(moves(scene)) {
        consider(scene);
        if (!may_appear_) return;
        Scene now = scene;
        const int frames = scene.animation.frames, counted = std::min(frames, kCountedFrames);
        for (int i = 0; i < counted; ++i) {
            const int frame = 1 + int(int64_t(i) * (frames - 1) / std::max(counted - 1, 1));
            for (const MovingPart& part : scene.motion->parts)
                if (part.part == ScenePart::object)
                    MovedPart(part, scene.motion->file, frame, now).apply();
            consider(now);
        }
    }

    const glm::dvec3& of(size_t model) const { return scales_[model]; }

  private:
    static constexpr int kCountedFrames = 64;
    static constexpr double kSteps = 4;  // an octave, so that objects of all sizes share few grids

    void consider(const Scene& scene) {
        for (const Object& object : scene.objects) {
            if (!is_instanced(scene, object) || !(object.visible || may_appear_)) continue;
            glm::dvec3& largest = scales_[size_t(object.model)];
            for (int axis = 0; axis < 3; ++axis) {
                const double scale = glm::length(glm::dvec3(object.world_from_object[axis]));
                if (!(scale > 1)) continue;
                const double step = std::ceil(kSteps * std::log2(scale) - 1e-9);
                largest[axis] = std::max(largest[axis], std::exp2(step / kSteps));
            }
        }
    }

    std::vector<glm::dvec3> scales_;
    bool may_appear_;
};

/// Sets the voxel sizes of models for which the scene gives none. A `smooth` or `exact` instance
/// that is larger than its model gets voxels that are as large as the world's where it stands, but
/// no more voxels along an axis than the world has along its longest one; exact meshes of many
/// triangles get more. Cubes keep their size: large cubes are a style.
void size_instances(Scene& scene, AssetStore& meshes) {
    const double max_voxels = longest(glm::dvec3(scene.world.voxels));
    const LargestScales scales(scene);
    for (size_t number = 0; number < scene.models.size(); ++number) {
        Model& model = scene.models[number];
        if (model.is_sized || model.resolution > 0 || !model.voxels.empty()) continue;
        model.voxel_size = scene.world.voxel_size;
        const glm::dvec3 scale = shows_voxels(model.surface) ? glm::dvec3(1) : scales.of(number);
        if (scale != glm::dvec3(1)) {
            const glm::dvec3 sides = sides_of(model, meshes);
            for (int axis = 0; axis < 3; ++axis) {
                const double world = model.voxel_size[axis];
                const double edge = std::max(world / scale[axis], sides[axis] / max_voxels);
                model.voxel_size[axis] = std::min(edge, world);
            }
        }
        model.voxel_size = sparse_voxel_size(scene, number, meshes);
    }
}

}  // namespace

void make_choices(Scene& scene, AssetStore& meshes) {
    size_instances(scene, meshes);
    choose_surfaces(scene, meshes);
    choose_placements(scene, meshes);
    size_instances(scene, meshes);  // sizes objects that became instances, too
}

}  // namespace voxelume
