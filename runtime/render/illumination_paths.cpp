// SPDX-License-Identifier: Apache-2.0
// Global light: the paths that sight rays begin, and the rays that these send to emitters.
#include "runtime/render/illumination.hpp"

namespace voxelume {

/// Follows the rays that paths have sent to emitters, apart from the paths' own rays, so that no
/// two rays add to one sight ray at once.
void Illumination::trace_to_emitters(PathDepth& depth, uint32_t count) {
    NodeLight light = {depth.nodes.radiance, {}, depth.nodes.stride};
    while (count > 0) {
        secondary_rays_ += count;
        std::swap(static_cast<RayQueue&>(depth.to_emitters), depth.next_to_emitters);
        trace_.closest(world_, depth.to_emitters, count, true);
        shade_.surface(world_, depth.to_emitters, count, false);
        if (medium_) medium_->sight(world_, depth.to_emitters, count);
        RayQueue none;
        count = extend_
                    ->paths(world_, sampling_, emitters_, depth.to_emitters, count, false, light,
                            depth.next_to_emitters, none)
                    .paths;
    }
}

/// Finds the paths that the medium scatters before their hits. Returns the number of the points.
uint32_t Illumination::scatter_in_medium(RayBatch& entries, uint32_t count, PathDepth& depth) {
    if (!medium_paths_) return 0;
    return medium_paths_->scatter(world_, sampling_, entries, count, depth.points);
}

/// Queues shadow rays from the points in the medium to a light.
void Illumination::send_to_points(const PathLight& light, uint32_t count, PathDepth& depth) {
    if (light.area)
        medium_paths_->add_area_light(world_, light.record, *light.area, sampling_, light.number,
                                      depth.points, count, queue_);
    else
        medium_paths_->add_light(world_, light.record, depth.points, count, queue_);
}

/// Adds the light of lights at a finite distance that the medium scatters along the rays: from
/// points where each of the lights is strongest. Paths that the medium scatters find the rest of
/// this light.
void Illumination::light_near_points(RayBatch& entries, uint32_t count, bool is_first,
                                     PathDepth& depth) {
    if (!features_.near_light) return;
    for (const LightTree& tree : light_trees()) {
        const uint32_t found = medium_paths_->near_chosen(world_, tree, sampling_, is_first,
                                                          entries, count, depth.points);
        if (found == 0) continue;
        medium_paths_->add_chosen_light(world_, tree, sampling_, true, depth.points, found, queue_);
        bring_light(depth.points, found);
        medium_paths_->add_near(depth.points, found, depth.nodes);
    }
    for (size_t i = 0; i < lights_.size(); ++i) {
        const LightRecord& light = lights_[i].record;
        if (light.kind == VXL_LIGHT_DIRECTIONAL) continue;
        const uint32_t found =
            medium_paths_->near(world_, light, sampling_, is_first, entries, count, depth.points);
        if (found == 0) continue;
        bring_light_of(i, depth.points, found,
                       [&](const PathLight& of) { send_to_points(of, found, depth); });
        medium_paths_->add_near(depth.points, found, depth.nodes);
    }
}

/// Lights the points where the medium scatters paths, and writes the paths' next rays behind
/// `taken` rays.
NextRays Illumination::light_medium(uint32_t count, uint32_t taken, PathDepth& depth) {
    if (count == 0) return {};
    for (const LightTree& tree : light_trees()) {
        medium_paths_->add_chosen_light(world_, tree, sampling_, false, depth.points, count,
                                        queue_);
        bring_light(depth.points, count);
    }
    const auto send = [&](const PathLight& light) { send_to_points(light, count, depth); };
    for (size_t i = 0; i < lights_.size(); ++i) bring_light_of(i, depth.points, count, send);
    return medium_paths_->paths(world_, sampling_, emitters_, depth.points, count, depth.nodes,
                                depth.next, taken, depth.next_to_emitters);
}

/// Adds the light of area lights that paths run into before they meet anything else.
void Illumination::meet_lights(RayBatch& entries, uint32_t count, PathDepth& depth) {
    if (!features_.meets_lights) return;
    for (const PathLight& light : lights_)
        if (light.area && light.area->axis_y.w > 0)
            area_lighting_->meet(world_, light.record, *light.area, surroundings_, entries, count,
                                 depth.nodes);
    for (const LightTree& tree : light_trees())
        if (tree.has_areas)
            area_lighting_->meet_all(world_, tree, surroundings_, entries, count, depth.nodes);
}

/// Follows the paths that the batch's rays begin, from surface to surface, all together, and fills
/// their radiance and coverage.
void Illumination::trace_paths(RayBatch& batch, uint32_t count, bool hits_are_known) {
    reserve_depth(0, batch.stride);
    PathDepth& depth = *depths_[0];
    RayBatch* entries = &batch;
    for (bool is_first = true; count > 0; is_first = false) {
        if (!is_first || !hits_are_known) trace_.closest(world_, *entries, count, !is_first);
        if (!is_first) meet_lights(*entries, count, depth);
        if (!is_first) light_near_points(*entries, count, false, depth);
        const uint32_t scattered = scatter_in_medium(*entries, count, depth);
        direct(*entries, count, is_first);
        const NextRays sent =
            extend_->paths(world_, sampling_, emitters_, *entries, count, is_first, depth.nodes,
                           depth.next, depth.next_to_emitters);
        trace_to_emitters(depth, sent.to_emitters);
        const NextRays in_medium = light_medium(scattered, sent.paths, depth);
        trace_to_emitters(depth, in_medium.to_emitters);
        // The light of the nodes begins with their rays' own hits.
        if (is_first) light_near_points(*entries, count, true, depth);
        count = sent.paths + in_medium.paths;
        if (count > 0) std::swap(static_cast<RayQueue&>(depth.entries), depth.next);
        entries = &depth.entries;
        secondary_rays_ += count;
    }
    std::swap(batch.radiance, depth.nodes.radiance);
    if (features_.transmission) std::swap(batch.coverage, depth.nodes.coverage);
}

void Illumination::light_layers(RayBatch& batch, uint32_t count, const LayerSink& sink) {
    if (!layers_) layers_ = allocate_layers(device_, features_, batch.stride);
    begin_paths(batch, count);
    RayBatch* entries = &batch;
    for (bool is_first = true; count > 0; is_first = false) {
        trace_.closest(world_, *entries, count);
        if (!is_first) depths_[0]->nodes.radiance.fill(0);
        trace_paths(*entries, count, true);
        NodeLight own = {entries->radiance, entries->coverage, entries->stride};
        sink(*entries, count, is_first, own);
        Children none;
        count = scatter_->layer(world_, *entries, count, is_first, none, own, layers_->next);
        if (count > 0) std::swap(static_cast<RayQueue&>(layers_->entries), layers_->next);
        entries = &layers_->entries;
        secondary_rays_ += count;
    }
}

}  // namespace voxelume
