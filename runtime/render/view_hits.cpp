// SPDX-License-Identifier: Apache-2.0
// The hits of sight rays that a renderer retains, lends to others, or takes from before.
#include <algorithm>

#include "runtime/analysis/scene_features.hpp"
#include "runtime/memory/plan.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/trace/ray_arrays.hpp"

namespace voxelume {
namespace {

/// The features on which the hits and batches of sight rays depend, without those that only decide
/// their light.
Features without_light(Features features) {
    features.shadows = features.area_samples = features.checker = false;
    features.medium = features.medium_grid = features.scattering = features.absorbs = false;
    features.filter = features.filtered_refraction = features.physical = false;
    features.rough_glass = features.area_shares = features.meets_lights = false;
    features.sky = features.sky_rays = 0;
    features.sky_hidden = features.direct_alone = false;
    return features;
}

}  // namespace

Renderer::View Renderer::view_of(const Scene& scene, const BuiltWorld& world,
                                 const Features& features) {
    View view{world.version, scene.observer, scene.render, without_light(features), {}};
    for (const Material& material : scene.materials) view.transmits.push_back(transmits(material));
    return view;
}

/// True if hits may be retained: they must take a small part of the device's memory, and none that
/// the frame itself needs in addition to the world.
bool Renderer::has_room(const Scene& scene, const Features& features, uint64_t rays) const {
    if (!follows_ && !has_passes_) return false;
    const double bytes = double(rays) * sight_bytes(features),
                 memory = double(device_.info().memory);
    if (!follows_ && bytes > kMaxPassHitBytes) return false;
    const double needed = ray_bytes(features, ray_counts(device_, scene, features)).maximum() +
                          image_bytes(scene.render);
    const auto locked = device_.lock();
    return bytes <= memory / 16 &&
           double(device_.counters().bytes_in_use) + needed + bytes <= memory;
}

/// Looks for known hits of the view, and frees hits of other views.
Renderer::ViewHits Renderer::begin_view(const Scene& scene, const BuiltWorld& world,
                                        const Features& features, int samples,
                                        const TileShare& share) {
    ViewHits hits{view_of(scene, world, features)};
    hits.in_batch = batch_tiles(device_, features, samples, share.maximum());
    hits.are_lent = lender_ && !moments_ && lender_->lends_hits(hits.view, hits.in_batch);
    if (hits.are_lent) hits.in_batch = lender_->tiles_in_batch_;
    const bool has_hits = !hits_.empty() && tiles_in_batch_ == hits.in_batch;
    hits.are_known = hits.are_lent || (!moments_ && view_ == hits.view && has_hits);
    view_.reset();  // an error may leave the hits incomplete
    if (!hits.are_known) hits_.clear();
    tiles_in_batch_ = hits.in_batch;
    hits.are_kept =
        !moments_ && has_room(scene, features, 16ull * share.tiles() * uint32_t(samples));
    return hits;
}

/// Gives the batch the hits of the tiles from `first` on.
void Renderer::take_known(const ViewHits& hits, uint32_t first, RayBatch& batch) const {
    const std::vector<SightHits>& known = hits.are_lent ? lender_->hits_ : hits_;
    const SightHits& those = *std::ranges::find(known, first, &SightHits::first);
    batch.rays = those.rays;
    batch.hits = those.hits;
}

}  // namespace voxelume
