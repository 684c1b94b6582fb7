// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/image_programs.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "kernels/shared/trace.h"
#include "runtime/analysis/scene_features.hpp"
#include "runtime/scene/first_samples.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/light/light_beams.hpp"
#include "runtime/stages/resolve/resolve.hpp"
#include "runtime/stages/trace/beam.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

/// A kernel of the image's stages, and when a run launches it.
struct KernelRow {
    std::string_view file;
    ForeseenKernel kernel;
    bool (*is_launched)(const Features& f);
};

bool always(const Features&) {
    return true;
}

/// True if paths are followed in local light, depth by depth.
bool follows(const Features& f) {
    return f.paths && !f.global;
}

/// The kernels that most images take. The process that renders compiles the others itself: those
/// for a medium's points near lights, for mattes, for area lights in a medium, and for lights
/// without an area that shine together with area lights, or with many others, in global light.
constexpr KernelRow kKernels[] = {
    {"sight.cl", {"cast_sight"}, always},
    {"trace.cl", {"trace_closest"}, always},
    {"trace.cl", {"trace_shadows"}, [](const Features& f) { return f.shadows; }},
    {"trace.cl", {"begin_inside"}, [](const Features& f) { return f.observer_in_medium; }},
    {"trace.cl",
     {"trace_scattered"},
     [](const Features& f) {
         return VXL_REFILLS_LANES(f.paths, f.instances, f.solids_ahead) != 0;
     }},
    {"shade.cl", {"shade_surface"}, always},
    {"light.cl",
     {"add_light"},
     [](const Features& f) { return !f.global || !(f.area_samples || f.chosen_lights); }},
    {"light_tree.cl", {"add_chosen_light"}, always},
    {"sky_light.cl", {"add_sky_light"}, always},
    {"light_beams.cl", {"send_light_beams"}, always},
    {"medium.cl", {"absorb_sight"}, always},
    {"medium.cl", {"absorb_shadows"}, [](const Features& f) { return f.medium && !f.filter; }},
    {"medium_paths.cl", {"scatter_in_medium"}, always},
    {"medium_paths.cl",
     {"add_light_to_medium"},
     [](const Features& f) { return !f.chosen_lights; }},
    {"light_tree_medium.cl", {"add_chosen_light_to_medium"}, always},
    {"medium_paths.cl", {"extend_in_medium"}, always},
    {"scatter.cl", {"begin_paths"}, always},
    {"scatter.cl", {"pass_layer"}, [](const Features& f) { return follows(f) && f.transmission; }},
    {"scatter.cl", {"scatter_rays"}, follows},
    {"scatter.cl", {"gather_light", WorkItem::light}, follows},
    {"extend.cl", {"extend_paths"}, always},
    {"area_light.cl", {"add_area_light"}, [](const Features& f) { return f.asked_areas; }},
    {"area_light.cl",
     {"meet_area_light"},
     [](const Features& f) { return f.meets_lights && f.asked_areas; }},
    {"area_light.cl",
     {"meet_area_lights"},
     [](const Features& f) { return f.meets_lights && f.chosen_areas; }},
    {"resolve.cl", {"resolve_pixels"}, always},
};

/// True for images that one call of the stages makes.
bool is_made_at_once(const Scene& scene) {
    const RenderSettings& render = scene.render;
    return render.shows_image && !render.channels.has_passes() && !render.channels.variance &&
           !render.noise.is_given() && !is_adaptive(render) && !adds_samples(render) &&
           scene.observer.shutter == 0;
}

/// True if two boxes overlap like those of a floor and an object on it: along two axes one lies
/// within the other, and along the third neither does.
bool stand_on_each_other(const VoxelBox& a, const VoxelBox& b) {
    if (!overlap(a, b)) return false;
    int a_within = 0, b_within = 0;
    for (int axis = 0; axis < 3; ++axis) {
        a_within += int(a.low[axis] >= b.low[axis] && a.high[axis] <= b.high[axis]);
        b_within += int(b.low[axis] >= a.low[axis] && b.high[axis] <= a.high[axis]);
    }
    return (a_within == 2 && b_within == 0) || (b_within == 2 && a_within == 0);
}

VoxelBox grown(const VoxelBox& box, double by) {
    return {box.low - by, box.high + by};
}

/// True if some voxel lists distance fields, as voxels shared by several objects do. Objects that
/// stand on each other are assumed to share voxels, objects a voxel apart to share none. The result
/// is empty where only building the world can tell: for other objects, and for very many objects.
std::optional<bool> lists_fields(const Scene& scene, const Pyramid& world) {
    struct Placed {
        VoxelBox box;
        bool is_smooth;
    };
    constexpr size_t kMaxObjects = 300;  // each object is compared with each other
    std::vector<Placed> placed;
    bool may_meet = false;
    const auto is_smooth_model = [](const Model& model) { return stores_distances(model.surface); };
    if (std::ranges::none_of(scene.models, is_smooth_model)) return false;
    if (scene.objects.size() > kMaxObjects) return std::nullopt;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (is_empty(world.object_boxes[i]) || is_instanced(scene, object)) continue;
        const VoxelBox box = grown(world.object_boxes[i], -1);  // see object_boxes()
        const bool is_smooth = is_smooth_model(scene.models[size_t(object.model)]);
        for (const Placed& other : placed) {
            if (!is_smooth && !other.is_smooth) continue;
            if (stand_on_each_other(box, other.box)) return true;
            may_meet |= overlap(grown(box, 1), other.box);
        }
        placed.push_back({box, is_smooth});
    }
    return may_meet ? std::nullopt : std::optional(false);
}

bool sends_beams(const Features& features, const Scene& scene, const Pyramid& world) {
    const Camera camera = camera_of(scene, world.frame);
    const uint64_t rays =
        16ull * tile_count(camera.width, camera.height) * uint64_t(camera.samples);
    return dilation_that_pays(features, world, rays, voxels_a_pixel(scene, camera, world.frame))
        .has_value();
}

}  // namespace

std::vector<const char*> sight_files(const Features& features, const Scene& scene,
                                     const Pyramid& world, bool makes_image,
                                     bool has_dilated_occupancy) {
    std::vector<const char*> files = {"sight.cl", "trace.cl", "shade.cl"};
    const bool is_lit = has_light(features, scene, world);
    if (is_lit) files.push_back("light.cl");
    if (is_lit && features.chosen_lights) files.push_back("light_tree.cl");
    if (is_lit && has_sky_samples(scene)) files.push_back("sky_light.cl");
    if (has_dilated_occupancy && lights_send_beams(features)) files.push_back("light_beams.cl");
    if (features.absorbs) files.push_back("medium.cl");
    if (features.scattering) files.push_back("medium_paths.cl");
    if (features.scattering && features.chosen_lights) files.push_back("light_tree_medium.cl");
    if (features.near_light) files.push_back("near_light.cl");
    if (features.paths) files.push_back("scatter.cl");
    if (features.global) files.push_back("extend.cl");
    if (features.asked_areas || (features.chosen_areas && features.meets_lights))
        files.push_back("area_light.cl");
    if (makes_image) files.push_back("resolve.cl");
    const ImageChannels& channels = scene.render.channels;
    if (makes_image && (channels.object_matte || channels.material_matte))
        files.push_back("matte.cl");
    return files;
}

std::vector<ForeseenKernel> image_kernels(const std::vector<const char*>& files,
                                          const Features& features, bool has_dilated_occupancy) {
    std::vector<ForeseenKernel> kernels;
    for (const auto& [file, kernel, is_launched] : kKernels)
        if (std::ranges::find(files, file) != files.end() && is_launched(features))
            kernels.push_back(kernel);
    if (has_dilated_occupancy) kernels.push_back({"start_beams"});
    return kernels;
}

ForeseenImage foreseen_image(const Scene& scene, const Pyramid& world) {
    if (!is_made_at_once(scene)) return {};
    const std::optional<bool> has_lists = lists_fields(scene, world);
    if (!has_lists) return {};
    ForeseenImage image;
    image.features = features_of(scene, world);
    image.features.field_lists = *has_lists;
    const bool has_beams = sends_beams(image.features, scene, world);
    image.files = sight_files(image.features, scene, world, true, has_beams);
    image.kernels = image_kernels(image.files, image.features, has_beams);
    return image;
}

void compile_ahead(const Device& device, const RenderSettings& render, const ForeseenImage& image) {
    if (image.files.empty()) return;
    Program::foresee(device, {image.files, resolve_defines(device, image.features, render.channels),
                              image.kernels});
}

}  // namespace voxelume
