#include "runtime/illumination.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <set>

#include "kernels/shared/solid.h"
#include "kernels/shared/voxel.h"
#include "runtime/instances.hpp"
#include "runtime/interior.hpp"
#include "runtime/object_boxes.hpp"
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

ShadowQueue allocate_shadow_queue(const Device& device, const Features& features, uint32_t stride) {
    ShadowQueue queue;
    if (!features.shadows && !features.medium) return queue;
    queue.count = Buffer<uint32_t>(device, "shadow queue", 1);
    if (features.shadows) {
        queue.traced = Buffer<uint32_t>(device, "shadow rays", 2);
        queue.traced.fill(0);
    }
    queue.rays = Buffer<float>(device, "shadow queue", size_t(stride) * VXL_RAY_COMPONENTS);
    queue.targets = Buffer<uint32_t>(device, "shadow queue", stride);
    if (features.exact()) queue.sources = Buffer<uint32_t>(device, "shadow queue", stride);
    queue.shares = Buffer<float>(device, "shadow queue", size_t(stride) * 3);
    return queue;
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

/// Whether any surface that may be shown sends rays on, other than straight through.
bool scatters(const Features& features, const Scene& scene, const Pyramid& world) {
    return features.refracts ||
           std::ranges::any_of(shown_materials(scene, world),
                               [](const Material* m) { return m->reflection > 0; });
}

/// Arrays of rays on their way.
RayQueue allocate_queue(const Device& device, const Features& features, uint32_t places) {
    RayQueue queue;
    queue.rays = Buffer<float>(device, "rays", size_t(places) * VXL_RAY_COMPONENTS);
    if (!features.paths) return queue;
    const size_t components = features.transmission
                                  ? VXL_PATH_INSIDE + 1 + size_t(features.other_members)
                              : features.instances ? VXL_PATH_INSIDE
                                                   : VXL_PATH_CELL;
    queue.paths = Buffer<uint32_t>(device, "paths", places * components);
    if (!features.transmission) return queue;
    queue.starts = Buffer<float>(device, "path starts", places);
    queue.inside = Buffer<uint32_t>(device, "path media", places);
    return queue;
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
    features.shadows = scene.render.shadows && has_light(scene, world);
    features.patches =
        has_lamp(scene, world) || std::ranges::any_of(scene.lights, [](const Light& light) {
            return shines(light) && has_area(light);
        });
    features.medium = scene.world.medium.absorption != glm::vec3(0);
    features.medium_grid = features.medium && has_density(scene.world.medium);
    add_paths(scene, world, features);
    add_interior(scene, world, features);
    return features;
}

void build_programs(const Device& device, const Features& features, const Scene& scene,
                    const Pyramid& world) {
    std::vector<const char*> files = {"sight.cl", "trace.cl", "shade.cl"};
    if (has_light(scene, world)) files.push_back("light.cl");
    if (features.absorbs) files.push_back("medium.cl");
    if (features.paths) files.push_back("scatter.cl");
    Program::build_together(device, files, features.defines(device));
}

RayBatch allocate_batch(const Device& device, const Features& features, uint32_t stride) {
    RayBatch batch;
    static_cast<RayQueue&>(batch) = allocate_queue(device, features, stride);
    batch.stride = stride;
    const size_t hit_components = features.instances ? VXL_HIT_COMPONENTS
                                  : features.exact() ? VXL_HIT_INSTANCE
                                                     : VXL_HIT_PRIMITIVE;
    batch.hits = Buffer<uint32_t>(device, "hits", stride * hit_components);
    batch.positions = Buffer<float>(device, "positions", size_t(stride) * 3);
    batch.normals = Buffer<float>(device, "normals", size_t(stride) * 3);
    batch.words = Buffer<uint32_t>(device, "words", stride);
    batch.radiance = Buffer<float>(device, "radiance", size_t(stride) * 3);
    if (features.paths) batch.sides = Buffer<uint32_t>(device, "sides", stride);
    if (features.paths && features.absorbs)
        batch.passed = Buffer<float>(device, "passed", size_t(stride) * 3);
    if (features.transmission) batch.coverage = Buffer<float>(device, "coverage", stride);
    return batch;
}

void renew_sight(const Device& device, RayBatch& batch) {
    batch.rays = Buffer<float>(device, "rays", batch.rays.size());
    batch.hits = Buffer<uint32_t>(device, "hits", batch.hits.size());
}

Illumination::Illumination(const Device& device, const Features& features, const Scene& scene,
                           const Pyramid& world, uint32_t most_rays, bool compact)
    : device_(device),
      features_(features),
      world_(world),
      lights_(light_records(device, features, scene, world)),
      most_rays_(most_rays),
      most_depth_(scatters(features, scene, world) ? size_t(scene.render.depth) : 0),
      trace_(device, features),
      shade_(device, features, scene, world.frame),
      surroundings_{shade_.materials(), shade_.ranks(), allocate_lost(device, features)},
      queue_(lights_.empty()
                 ? ShadowQueue{}
                 : allocate_shadow_queue(device, features,
                                         std::bit_ceil((features.refracts ? 2 : 1) * most_rays))) {
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
    Depth& depth = *depths_[0];
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
    Depth& depth = *depths_[number];
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
    const uint32_t branches = features_.refracts ? 2 : 1;
    for (uint32_t begin = 0; begin < count; begin += most_rays_) {
        const uint32_t end = std::min(count, begin + most_rays_);
        reserve_nodes(number + 1, branches * (end - begin));
        Depth& depth = *depths_[number];
        Depth& below = *depths_[number + 1];
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
    if (depths_.size() <= number) depths_.push_back(std::make_unique<Depth>());
    Depth& depth = *depths_[number];
    const bool is_first = number == 0;
    if (is_first ? count == depth.nodes.stride : count <= depth.nodes.stride) return;
    const uint32_t places = is_first ? count : std::max(std::bit_ceil(count), 16u);
    depth = Depth{};
    if (features_.transmission || !is_first)
        depth.entries = allocate_batch(device_, features_, places);
    depth.nodes.stride = places;
    if (features_.transmission) {
        depth.next = allocate_queue(device_, features_, places);
        depth.nodes.radiance = Buffer<float>(device_, "node light", size_t(places) * 3);
        if (is_first) depth.nodes.coverage = Buffer<float>(device_, "node coverage", places);
        depth.children.gains = Buffer<float>(device_, "path gains", size_t(places) * 3);
    }
    const size_t branches = features_.refracts ? 2 : 1;
    depth.children.nodes = Buffer<uint32_t>(device_, "path children", places * branches);
    depth.children.shares = Buffer<float>(device_, "path shares", places * branches);
}

uint64_t Illumination::lost_members() const {
    return surroundings_.lost.empty() ? 0 : surroundings_.lost.read_one(0);
}

uint64_t Illumination::shadow_rays() const {
    if (queue_.traced.empty()) return 0;
    return queue_.traced.read_one(0) | uint64_t(queue_.traced.read_one(1)) << 32;
}

}  // namespace voxelume
