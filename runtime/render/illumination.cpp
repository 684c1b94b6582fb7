// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/illumination.hpp"

#include <algorithm>
#include <cstring>

#include "kernels/shared/solid.h"
#include "kernels/shared/voxel.h"
#include "runtime/analysis/image_programs.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/light/emitters.hpp"
#include "runtime/stages/light/light_samples.hpp"
#include "runtime/stages/resolve/resolve.hpp"

namespace voxelume {
namespace {

/// All lights as points and directions; lights with an area are replaced by their samples.
std::vector<PathLight> lights_by_samples(const Device& device, const Features& features,
                                         const Scene& scene, const Pyramid& world) {
    std::vector<LightRecord> records = given_lights(scene, world.frame);
    if (has_emissive_object(scene, world))
        std::ranges::copy(emissive_light_samples(device, features, scene, world),
                          std::back_inserter(records));
    std::vector<PathLight> lights;
    lights.reserve(records.size());
    for (const LightRecord& record : records) lights.push_back({record, {}, 0});
    return lights;
}

std::vector<PathLight> lights_of(const Device& device, const Features& features, const Scene& scene,
                                 const Pyramid& world) {
    if (!has_light(features, scene, world)) return {};
    std::vector<PathLight> lights = features.global
                                        ? path_lights(scene, world.frame)
                                        : lights_by_samples(device, features, scene, world);
    std::erase_if(lights,
                  [&](const PathLight& light) { return !may_light(light.record, world.frame); });
    return lights;
}

/// True if surface points send shadow rays to the sky.
bool looks_to_sky(const Features& features, const Scene& scene, const Pyramid& world) {
    return features.sky != VXL_SKY_NONE && has_sky_samples(scene) &&
           has_light(features, scene, world);
}

/// Allocates Surroundings::medium_overflows, set to 0; empty if the features don't need it.
Buffer<uint32_t> allocate_medium_overflows(const Device& device, const Features& features) {
    if (!features.medium_set_capped) return {};
    Buffer<uint32_t> medium_overflows(device, "medium overflows", 1);
    medium_overflows.fill(0);
    return medium_overflows;
}

/// The numbers of the first records of the solids that let light through, except those of
/// instances' models, which come after the world's.
Buffer<uint32_t> transmitting_solids(const Device& device, const Scene& scene,
                                     const Pyramid& world) {
    const std::vector<uint32_t> words = world.solids.read();
    std::vector<uint32_t> numbers;
    const std::vector<InstanceModel>& models = world.instances.models;
    const auto end =
        models.empty() ? uint32_t(words.size() / VXL_SOLID_WORDS) : models.front().first_solid;
    for (uint32_t i = 0; i < end; ++i) {
        SolidShape shape;
        std::memcpy(&shape, &words[size_t(i) * VXL_SOLID_WORDS], sizeof shape);
        const uint32_t material = shape.attribute >> VXL_MATERIAL_SHIFT & VXL_MATERIAL_MASK;
        if (shape.shape_count > 0 && transmits(scene.materials[material])) numbers.push_back(i);
    }
    return {device, "path bodies", std::span<const uint32_t>(numbers)};
}

}  // namespace

void build_programs(const Device& device, const Features& features, const Scene& scene,
                    const Pyramid& world, bool makes_image, bool has_dilated_occupancy) {
    const std::vector<const char*> files =
        sight_files(features, scene, world, makes_image, has_dilated_occupancy);
    const Defines defines =
        resolve_defines(device, features, scene.render.channels, adds_samples(scene.render));
    // What wasn't foreseen before the world was built is shared with a helper that compiles.
    Program::foresee(device,
                     {files, defines, image_kernels(files, features, has_dilated_occupancy)});
    Program::build_together(device, files, defines);
}

Illumination::Illumination(const Device& device, const Features& features, const Scene& scene,
                           const Pyramid& world, uint32_t max_rays, bool compact)
    : device_(device),
      features_(features),
      world_(world),
      lights_(lights_of(device, features, scene, world)),
      max_rays_(max_rays),
      max_depth_(max_depth(features, scene, world)),
      trace_(device, features),
      shade_(device, features, scene, world.frame),
      surroundings_{shade_.materials(), shade_.ranks(),
                    allocate_medium_overflows(device, features)},
      sky_samples_(looks_to_sky(features, scene, world) ? uint32_t(scene.world.sky->samples) : 0),
      queue_(lights_.empty() && sky_samples_ == 0
                 ? ShadowQueue{}
                 : allocate_shadow_queue(device, features, max_rays)) {
    if (features.chosen_lights) {
        const std::vector<std::vector<PathLight>> lists = chosen_lights(lights_, world.frame);
        light_trees_.emplace(device, features, shade_.materials(), lists, world.frame);
        for (const std::vector<PathLight>& list : lists) {
            std::erase_if(lights_, [&](const PathLight& light) {
                return may_be_chosen(light, world.frame) &&
                       light.area.has_value() == list.front().area.has_value();
            });
        }
    }
    std::erase_if(lights_, is_dark);
    const auto has_area = [](const PathLight& light) { return light.area.has_value(); };
    if (!std::ranges::all_of(lights_, has_area))
        lighting_.emplace(device, features, shade_.materials());
    if (sky_samples_ > 0) sky_lighting_.emplace(device, features, shade_.materials(), shade_.sky());
    if (features.absorbs)
        medium_.emplace(device, features, scene.world, shade_.environment(), shade_.materials(),
                        scene.lights);
    if (features.medium) {
        surroundings_.absorption = medium_->extinction();
        surroundings_.density = medium_->density();
    }
    if (features.paths)
        scatter_.emplace(device, features, surroundings_, float(scene.render.min_weight), compact);
    if (features.global) extend_.emplace(device, features, surroundings_);
    if (features.scattering)
        medium_paths_.emplace(device, features, shade_.environment().absorption,
                              medium_->scattering(), medium_->density());
    if (features.asked_areas || (features.chosen_areas && features.meets_lights))
        area_lighting_.emplace(device, features, shade_.materials());
    if (features.emitters != VXL_EMITTERS_NONE) {
        emitters_ = build_emitters(device, features, scene, world);
        shade_.set_emitters(emitters_);
    }
    if (features.sky_rays != VXL_EMITTERS_NONE) {
        if (emitters_.count > 0) shade_.set_sky_chance(1 - kEmitterChanceWithSky);
        extend_->set_sky(shade_.sky().map);
        if (medium_paths_) medium_paths_->set_sky(shade_.sky().map);
    }
    if (features.observer_in_medium) {
        hollow_ = hollow_objects(scene);
        hollow_flags_ =
            Buffer<uint32_t>(device, "hollow objects", std::span<const uint32_t>(hollow_.flags));
    }
    if (features.transmission && features.solids)
        scatter_->set_bodies(transmitting_solids(device, scene, world));
}

void Illumination::send_beams(const DilatedOccupancy& dilated_occupancy, uint32_t maximum,
                              std::vector<LightBeams>& sent) {
    std::vector<LightRecord> records;
    records.reserve(lights_.size());
    for (const PathLight& light : lights_) records.push_back(light.record);
    for (const BeamGrid& grid :
         beam_grids(records, world_.frame.size, scale_of(dilated_occupancy.of), maximum,
                    kLightsOfMaxBeams * maximum)) {
        const auto known = std::ranges::find_if(
            sent, [&](const LightBeams& kept) { return same_beams(kept.grid, grid); });
        beams_.push_back({grid, known == sent.end() ? Buffer<float>() : known->ends});
    }
    sent.clear();  // frees their memory before others take memory
    std::optional<LightBeamStage> stage;
    for (LightBeams& beams : beams_) {
        if (beams.grid.columns == 0 || !beams.ends.empty()) continue;
        if (!stage) stage.emplace(device_, features_, world_, dilated_occupancy);
        beams.ends = stage->send(beams.grid);
    }
    if (stage) light_beams_ = stage->sent();
    sent = beams_;
}

void Illumination::light_all(RayBatch& batch, uint32_t count, const LayerSink& sink,
                             bool hits_are_known) {
    if (features_.paths) begin_paths(batch, count);
    if (features_.global && features_.radiance) {
        trace_paths(batch, count, hits_are_known);
        if (sink && features_.transmission)
            sink(batch, count, true, {batch.radiance, batch.coverage, batch.stride});
        return;
    }
    if (!features_.paths || !features_.radiance) {
        if (!hits_are_known) trace_.closest(world_, batch, count);
        return direct(batch, count, true);
    }
    reserve_depth(0, batch.stride);
    follow(0, batch, count, hits_are_known, sink);
    PathDepth& depth = *depths_[0];
    if (!features_.transmission) return;
    std::swap(batch.radiance, depth.nodes.radiance);
    std::swap(batch.coverage, depth.nodes.coverage);
}

void Illumination::find_hits(RayBatch& batch, uint32_t count) {
    if (features_.paths) begin_paths(batch, count);
    trace_.closest(world_, batch, count);
}

void Illumination::begin_paths(RayBatch& batch, uint32_t count) {
    scatter_->begin(world_, batch, count);
    if (features_.observer_in_medium)
        trace_.begin_inside(world_, surroundings_, hollow_flags_, hollow_.maximum, batch, count);
}

/// Lights the surfaces that the rays met: blocks 4 and 5.
void Illumination::direct(RayBatch& entries, uint32_t count, bool from_observer) {
    shade_.surface(world_, entries, count, from_observer);
    for (const LightTree& tree : light_trees()) {
        light_trees_->add(world_, tree, sampling_, entries, count, queue_);
        bring_light(entries, count);
    }
    const auto add = [&](const PathLight& light) {
        if (light.area)
            area_lighting_->add(world_, light.record, *light.area, sampling_, light.number, entries,
                                count, queue_);
        else
            lighting_->add(world_, light.record, entries, count, queue_);
    };
    for (size_t i = 0; i < lights_.size(); ++i) bring_light_of(i, entries, count, add);
    for (uint32_t i = 0; i < sky_samples_; ++i) {
        sky_lighting_->add(world_, i, sky_samples_, entries, count, queue_);
        bring_light(entries, count);
    }
    if (medium_) medium_->sight(world_, entries, count);
}

/// Lights points by light number `i`. `add` queues the shadow rays to it.
void Illumination::bring_light_of(size_t i, RayBatch& points, uint32_t count,
                                  const std::function<void(const PathLight&)>& add) {
    add(lights_[i]);
    if (!beams_.empty()) queue_.beams = beams_[i];
    bring_light(points, count);
    if (!beams_.empty()) queue_.beams = {};
}

/// Adds the light of the queued shadow rays that reach their light.
void Illumination::bring_light(RayBatch& entries, uint32_t count) {
    if (features_.medium && !features_.filter) medium_->shadows(world_, queue_, count, entries);
    if (features_.shadows) trace_.shadows(world_, surroundings_, queue_, count, entries);
}

/// Fills the nodes of a depth with the light of their rays, which are in `first`.
void Illumination::follow(size_t number, RayBatch& first, uint32_t count, bool hits_are_known,
                          const LayerSink& sink) {
    PathDepth& depth = *depths_[number];
    RayBatch* entries = &first;
    for (bool is_first = true; count > 0; is_first = false) {
        if (!is_first || !hits_are_known) trace_.closest(world_, *entries, count, number > 0);
        direct(*entries, count, number == 0);
        uint32_t on = 0;
        if (features_.transmission)
            on = scatter_->layer(world_, *entries, count, is_first, depth.children, depth.nodes,
                                 depth.next);
        else
            depth.nodes.radiance = entries->radiance;
        if (number < max_depth_) scatter(number, *entries, count);
        if (sink && features_.transmission) sink(*entries, count, is_first, depth.nodes);
        if (on > 0) std::swap(static_cast<RayQueue&>(depth.entries), depth.next);
        entries = &depth.entries;
        count = on;
        secondary_rays_ += on;
    }
}

/// Follows reflected and refracted rays in batches, as many as fit: blocks 6.1 to 9.
void Illumination::scatter(size_t number, RayBatch& entries, uint32_t count) {
    const uint32_t together = followed_points(max_rays_, number);
    reserve_depth(number + 1, depth_slots(features_, max_rays_, number + 1));
    for (uint32_t begin = 0; begin < count; begin += together) {
        const uint32_t end = std::min(count, begin + together);
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

/// Makes the arrays of a depth, unless it has them already.
void Illumination::reserve_depth(size_t number, uint32_t slots) {
    if (depths_.size() <= number) depths_.push_back(std::make_unique<PathDepth>());
    PathDepth& depth = *depths_[number];
    if (slots == depth.nodes.stride) return;
    depth = {};  // frees its old arrays
    depth = allocate_depth(device_, features_, number == 0, slots);
}

uint64_t Illumination::medium_overflows() const {
    return surroundings_.medium_overflows.empty() ? 0 : surroundings_.medium_overflows.read_one(0);
}

uint64_t Illumination::shadow_rays() const {
    if (queue_.traced.empty()) return 0;
    return queue_.traced.read_one(0) | uint64_t(queue_.traced.read_one(1)) << 32;
}

}  // namespace voxelume
