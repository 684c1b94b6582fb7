#include "runtime/illumination.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "kernels/shared/solid.h"
#include "kernels/shared/voxel.h"
#include "runtime/instances.hpp"
#include "runtime/interior.hpp"
#include "runtime/object_boxes.hpp"
#include "runtime/stages/sight.hpp"
#include "runtime/stages/spots.hpp"

namespace voxelume {
namespace {

bool shines(const Light& light) {
    return light.energy != glm::vec3(0);
}

bool has_area(const Light& light) {
    return light.kind == LightKind::disk || light.kind == LightKind::rectangle;
}

/// The objects that the world may show. Instances come into it and leave it without its being
/// formed anew, so all of them are among these.
std::vector<const Object*> shown_objects(const Scene& scene, const Pyramid& world) {
    std::vector<const Object*> shown;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (!object.visible || !object.in_reach) continue;
        const bool is_known = !world.object_boxes.empty() && !is_instanced(scene, object);
        if (is_known && is_empty(world.object_boxes[i])) continue;
        shown.push_back(&object);
    }
    return shown;
}

bool has_lamp(const Scene& scene, const Pyramid& world) {
    return std::ranges::any_of(shown_objects(scene, world),
                               [&](const Object* object) { return is_lamp(scene, *object); });
}

bool has_light(const Scene& scene, const Pyramid& world) {
    return std::ranges::any_of(scene.lights, shines) || has_lamp(scene, world);
}

std::vector<LightRecord> light_records(const Device& device, const Features& features,
                                       const Scene& scene, const Pyramid& world) {
    std::vector<LightRecord> records;
    for (const Light& light : scene.lights) {
        if (!shines(light)) continue;
        if (has_area(light))
            std::ranges::copy(area_spots(light, world.frame), std::back_inserter(records));
        else
            records.push_back(light_record(light, world.frame));
    }
    if (has_lamp(scene, world))
        std::ranges::copy(lamp_spots(device, features, scene, world), std::back_inserter(records));
    return records;
}

/// The materials of objects that the world may show.
std::vector<const Material*> shown_materials(const Scene& scene, const Pyramid& world) {
    std::set<int> numbers;
    for (const Object* object : shown_objects(scene, world)) {
        numbers.insert(object->material);
        for (const GroupMaterial& group : object->groups) numbers.insert(group.material);
    }
    std::vector<const Material*> materials;
    materials.reserve(numbers.size());
    for (const int number : numbers) materials.push_back(&scene.materials[size_t(number)]);
    return materials;
}

/// The features that the materials decide.
void add_paths(const Scene& scene, const Pyramid& world, Features& features) {
    const bool follows = scene.render.depth > 0;
    bool refraction = false, opacity = false, reflection = false, fresnel = false;
    bool absorption = false;
    opacity = features.voxel_opacity;
    for (const Material* m : shown_materials(scene, world)) {
        features.checker |= m->checker.has_value();
        refraction |= m->refraction > 0;
        opacity |= m->opacity < 1;
        reflection |= m->reflection > 0;
        fresnel |= m->fresnel && (m->reflection > 0 || m->refraction > 0);
        absorption |= m->absorption != glm::vec3(0) && (transmits(*m) || features.voxel_opacity);
    }
    features.transmission =
        opacity || (refraction && (follows || (features.shadows && scene.render.filtered_shadows)));
    const bool filters = features.shadows && features.transmission;
    features.refracts = follows && (refraction || fresnel);
    features.paths = features.transmission || (follows && reflection);
    features.absorbs = features.medium || (features.transmission && absorption);
    features.filter = filters;
    features.filtered_refraction = filters && scene.render.filtered_shadows;
    features.cube_bodies =
        features.transmission &&
        std::ranges::any_of(shown_objects(scene, world), [&](const Object* object) {
            return scene.models[size_t(object->model)].surface == Surface::cubes &&
                   (features.voxel_opacity || transmits(scene, *object));
        });
}

/// Reflections and refractions in a row: none where no surface that may be shown sends rays on,
/// other than straight through.
size_t most_depth(const Features& features, const Scene& scene, const Pyramid& world) {
    const bool scatters = features.refracts ||
                          std::ranges::any_of(shown_materials(scene, world),
                                              [](const Material* m) { return m->reflection > 0; });
    return scatters ? size_t(scene.render.depth) : 0;
}

/// Those that have arrays, at most: rays end whose weight is too small.
size_t reserved_depth(const Features& features, const Scene& scene, const Pyramid& world) {
    constexpr double kRounding = 1e-3;  // of the weights
    const auto depth = double(most_depth(features, scene, world));
    double share = 0;  // of a surface's light that one ray may bring
    for (const Material* m : shown_materials(scene, world))
        share = std::max(share, double(m->reflection) + double(m->refraction));
    if (depth == 0 || share >= 1) return size_t(depth);
    const double followed = std::log(scene.render.least_weight) / std::log(share);
    return size_t(std::min(depth, std::floor(followed + kRounding) + 1));
}

/// Surroundings::lost.
Buffer<uint32_t> allocate_lost(const Device& device, const Features& features) {
    if (!features.interior_capped) return {};
    Buffer<uint32_t> lost(device, "lost members", 1);
    lost.fill(0);
    return lost;
}

/// The first records of the solids that light goes through.
Buffer<uint32_t> transmitting_solids(const Device& device, const Scene& scene,
                                     const Pyramid& world) {
    const std::vector<uint32_t> words = world.solids.read();
    std::vector<uint32_t> numbers;
    for (uint32_t i = 0; i < words.size() / VXL_SOLID_WORDS; ++i) {
        SolidShape shape;
        std::memcpy(&shape, &words[size_t(i) * VXL_SOLID_WORDS], sizeof shape);
        const uint32_t material = shape.attribute >> VXL_MATERIAL_SHIFT & VXL_MATERIAL_MASK;
        if (shape.shape_count > 0 && transmits(scene.materials[material])) numbers.push_back(i);
    }
    return {device, "path bodies", std::span<const uint32_t>(numbers)};
}

}  // namespace

Features features_of(const Scene& scene, const Pyramid& world) {
    Features features = features_of(world);
    add_scene(scene, world, features);
    return features;
}

void add_scene(const Scene& scene, const Pyramid& world, Features& features) {
    features.shadows = scene.render.shadows && has_light(scene, world);
    features.patches =
        has_lamp(scene, world) || std::ranges::any_of(scene.lights, [](const Light& light) {
            return shines(light) && has_area(light);
        });
    features.medium = scene.world.medium.absorption != glm::vec3(0);
    features.medium_grid = features.medium && has_density(scene.world.medium);
    add_paths(scene, world, features);
    add_interior(scene, world, features);
}

RayBytes ray_bytes(const Scene& scene, const Features& features) {
    const Pyramid any;  // which may show all objects
    const RenderSettings& render = scene.render;
    const uint32_t tiles =
        batch_tiles(features, render.samples, tile_count(render.size.x, render.size.y));
    return ray_bytes(features, has_light(scene, any), tiles * 16 * uint32_t(render.samples),
                     reserved_depth(features, scene, any));
}

void build_programs(const Device& device, const Features& features, const Scene& scene,
                    const Pyramid& world) {
    std::vector<const char*> files = {"sight.cl", "trace.cl", "shade.cl"};
    if (has_light(scene, world)) files.push_back("light.cl");
    if (features.absorbs) files.push_back("medium.cl");
    if (features.paths) files.push_back("scatter.cl");
    Program::build_together(device, files, features.defines(device));
}

Illumination::Illumination(const Device& device, const Features& features, const Scene& scene,
                           const Pyramid& world, uint32_t most_rays, bool compact)
    : device_(device),
      features_(features),
      world_(world),
      lights_(light_records(device, features, scene, world)),
      most_rays_(most_rays),
      most_depth_(most_depth(features, scene, world)),
      trace_(device, features),
      shade_(device, features, scene, world.frame),
      surroundings_{shade_.materials(), shade_.ranks(), allocate_lost(device, features)},
      queue_(lights_.empty() ? ShadowQueue{} : allocate_shadow_queue(device, features, most_rays)) {
    if (!lights_.empty()) lighting_.emplace(device, features, shade_.materials());
    if (features.absorbs)
        medium_.emplace(device, features, scene.world, shade_.space(), shade_.materials());
    if (features.medium) {
        surroundings_.absorption = shade_.space().absorption;
        surroundings_.density = medium_->density();
    }
    if (features.paths)
        scatter_.emplace(device, features, surroundings_, float(scene.render.least_weight),
                         compact);
    if (features.immersed) {
        hollow_ = hollow_objects(scene);
        hollow_flags_ =
            Buffer<uint32_t>(device, "hollow objects", std::span<const uint32_t>(hollow_.flags));
    }
    if (features.transmission && features.solids)
        scatter_->set_bodies(transmitting_solids(device, scene, world));
}

void Illumination::light_all(RayBatch& batch, uint32_t count, const LayerSink& sink,
                             bool hits_are_known) {
    if (!features_.paths) {
        if (!hits_are_known) trace_.closest(world_, batch, count);
        return direct(batch, count);
    }
    scatter_->begin(world_, batch, count);
    if (features_.immersed)
        trace_.begin_inside(world_, surroundings_, hollow_flags_, hollow_.most, batch, count);
    reserve_nodes(0, batch.stride);
    follow(0, batch, count, hits_are_known, sink);
    PathDepth& depth = *depths_[0];
    if (!features_.transmission) return;
    std::swap(batch.radiance, depth.nodes.radiance);
    std::swap(batch.coverage, depth.nodes.coverage);
}

/// Blocks 4 and 5: lights what the rays have met.
void Illumination::direct(RayBatch& entries, uint32_t count) {
    shade_.surface(world_, entries, count);
    for (const LightRecord& light : lights_) {
        lighting_->add(world_, light, entries, count, queue_);
        if (features_.medium && !features_.filter) medium_->shadows(world_, queue_, count, entries);
        if (features_.shadows) trace_.shadows(world_, surroundings_, queue_, count, entries);
    }
    if (medium_) medium_->sight(world_, entries, count);
}

/// Fills the nodes of a depth, whose rays are in `first`.
void Illumination::follow(size_t number, RayBatch& first, uint32_t count, bool hits_are_known,
                          const LayerSink& sink) {
    PathDepth& depth = *depths_[number];
    RayBatch* entries = &first;
    for (bool is_first = true; count > 0; is_first = false) {
        if (!is_first || !hits_are_known) trace_.closest(world_, *entries, count, number > 0);
        direct(*entries, count);
        uint32_t on = 0;
        if (features_.transmission)
            on = scatter_->layer(world_, *entries, count, is_first, depth.children, depth.nodes,
                                 depth.next);
        else
            depth.nodes.radiance = entries->radiance;
        if (number < most_depth_) scatter(number, *entries, count);
        if (sink && features_.transmission) sink(*entries, count, is_first, depth.nodes);
        if (on > 0) std::swap(static_cast<RayQueue&>(depth.entries), depth.next);
        entries = &depth.entries;
        count = on;
        secondary_rays_ += on;
    }
}

/// Blocks 6.1 to 9: follows what surfaces reflect and refract, as much at a time as fits.
void Illumination::scatter(size_t number, RayBatch& entries, uint32_t count) {
    const uint32_t branches = branches_of(features_);
    for (uint32_t begin = 0; begin < count; begin += most_rays_) {
        const uint32_t end = std::min(count, begin + most_rays_);
        reserve_nodes(number + 1, branches * (end - begin));
        PathDepth& depth = *depths_[number];
        PathDepth& below = *depths_[number + 1];
        const uint32_t sent =
            scatter_->rays(world_, entries, begin, end, depth.children, below.entries);
        if (sent == 0) continue;
        secondary_rays_ += sent;
        follow(number + 1, below.entries, sent);
        scatter_->gather(entries, begin, end, depth.children, below.nodes, depth.nodes);
    }
}

/// Makes room for `count` nodes of a depth; of the first, whose arrays are exchanged with the
/// caller's, exactly so much.
void Illumination::reserve_nodes(size_t number, uint32_t count) {
    if (depths_.size() <= number) depths_.push_back(std::make_unique<PathDepth>());
    PathDepth& depth = *depths_[number];
    const bool is_first = number == 0;
    if (is_first ? count == depth.nodes.stride : count <= depth.nodes.stride) return;
    depth = {};  // frees what it had
    depth = allocate_depth(device_, features_, is_first, is_first ? count : depth_places(count));
}

uint64_t Illumination::lost_members() const {
    return surroundings_.lost.empty() ? 0 : surroundings_.lost.read_one(0);
}

uint64_t Illumination::shadow_rays() const {
    if (queue_.traced.empty()) return 0;
    return queue_.traced.read_one(0) | uint64_t(queue_.traced.read_one(1)) << 32;
}

}  // namespace voxelume
