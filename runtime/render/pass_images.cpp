// SPDX-License-Identifier: Apache-2.0
// An image's channels that show parts of its light, from the hits of its own sight rays.
#include <fmt/format.h>

#include <utility>

#include "runtime/render/light_passes.hpp"
#include "runtime/render/renderer.hpp"

namespace voxelume {
namespace {

/// The features on which the hits of given sight rays depend.
Features of_hits(const Features& all) {
    Features features;
    features.cubes = all.cubes;
    features.smooth = all.smooth;
    features.triangles = all.triangles;
    features.solids = all.solids;
    features.solids_ahead = all.solids_ahead;
    features.field_lists = all.field_lists;
    features.field_chains = all.field_chains;
    features.chain_depth = all.chain_depth;
    features.attributes = all.attributes;
    features.instances = all.instances;
    features.transmission = all.transmission;
    features.voxel_opacity = all.voxel_opacity;
    features.cube_bodies = all.cube_bodies;
    features.observer_in_medium = all.observer_in_medium;
    features.media = all.media;
    features.medium_set_capped = all.medium_set_capped;
    return features;
}

/// The settings on which sight rays depend.
RenderSettings of_sight(const RenderSettings& all) {
    RenderSettings settings;
    settings.size = all.size;
    settings.crop = all.crop;
    settings.samples = all.samples;
    settings.first_sample = all.first_sample;
    settings.filter = all.filter;
    return settings;
}

}  // namespace

/// True if the sight rays of both views have the same hits, even if their light differs.
bool Renderer::have_equal_hits(const View& a, const View& b) {
    return a.world == b.world && a.observer == b.observer && a.transmits == b.transmits &&
           of_sight(a.settings) == of_sight(b.settings) &&
           of_hits(a.features) == of_hits(b.features);
}

/// True if a pass of the light, with batches of at most `max_tiles`, can reuse this image's hits.
bool Renderer::lends_hits(const View& view, uint32_t max_tiles) const {
    return view_ && !hits_.empty() && tiles_in_batch_ <= max_tiles && have_equal_hits(view, *view_);
}

/// Sets the moments of the samples to those of an image, or of one of its passes.
void Renderer::show_moments_of(const Renderer& image, std::optional<size_t> pass) {
    moments_ = image.moments_;
    image_settings_ = image.image_settings_;
    pass_ = pass;
}

/// Adds the channels that show parts of the light. Tiles that were rendered get as many samples as
/// in the image.
void Renderer::add_passes(const std::vector<LightPass>& passes, const BuiltWorld& world,
                          const Tiles& tiles, Sampled& sampled, RenderReport& report,
                          Image& image) const {
    for (size_t i = 0; i < passes.size(); ++i) {
        const LightPass& pass = passes[i];
        RenderReport of_pass;
        TileShare share(tiles.share, tiles.taken, first_weight(pass.scene, tiles.weight));
        std::vector<TileRange> taken;
        Renderer renderer(device_, false);
        renderer.is_white_ = pass.is_white;
        renderer.show_moments_of(*this, i);
        if (has_passes_) renderer.lender_ = this;
        renderer.dilated_occupancy_ = dilated_occupancy_;
        Image light = renderer.sampled_image(pass.scene, world, of_pass,
                                             {share, taken, tiles.weight}, sampled);
        of_pass.noise = {};
        if (pass.name.empty()) {
            image.planes.merge(light.planes);
            image.attributes.merge(light.attributes);
        } else {
            for (const char* color : {"R", "G", "B"})
                image.planes[fmt::format("{}.{}", pass.name, color)] =
                    std::move(light.planes.at(color));
        }
        add_counts(of_pass, report);
        report.image_seconds += of_pass.image_seconds;
    }
}

}  // namespace voxelume
