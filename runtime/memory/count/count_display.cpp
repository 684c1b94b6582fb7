// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/count_display.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <optional>

#include "runtime/analysis/coverage.hpp"
#include "runtime/analysis/medium_set.hpp"
#include "runtime/analysis/scene_features.hpp"
#include "runtime/analysis/volume_scene.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/stages/display/display_cover.hpp"
#include "runtime/stages/display/display_frame.hpp"
#include "runtime/stages/display/display_lattice.hpp"
#include "runtime/stages/display/display_mean.hpp"
#include "runtime/stages/display/display_medium.hpp"
#include "runtime/stages/display/display_rays.hpp"
#include "runtime/stages/display/display_samples.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

/// The buffers for lighting batches of rays that begin at a display.
struct DisplayLight {
    RayArrays rays;
    DensityGrid density;
    Buffer<uint8_t> tables;
};

DisplayLight count_light(const Device& device, const Scene& scene, const Features& features,
                         RayCounts counts, const DensityPlan& medium) {
    DisplayLight light;
    light.rays = allocate_rays(device, features, counts);
    light.tables = count_tables(device, scene);
    if (features.medium_grid) light.density = allocate_density(device, medium.size);
    return light;
}

/// The number of voxels of the world's surface in a lattice whose voxels have this `edge`.
double surface_voxels(const Pyramid& world, double edge) {
    const glm::dvec3& e = world.frame.voxel_edge;
    const double own = std::cbrt(e.x * e.y * e.z) / edge;
    return double(world.voxel_count) * own * own;
}

/// The count as a 32-bit number; devices refuse larger ones.
uint32_t numbered(double count) {
    return uint32_t(std::min(count, double(UINT32_MAX - 16)));
}

double mean_edge(const glm::dvec3& edge) {
    return std::cbrt(edge.x * edge.y * edge.z);
}

/// The number of points where probe lines cross surfaces. The distance between lines is at most the
/// edge of the world's voxels.
double probe_points(const VolumeFrame& frame, const Pyramid& world) {
    const glm::dvec3& e = world.frame.voxel_edge;
    const double widest = std::min({e.x, e.y, e.z});
    const glm::dvec3 spacing = frame.edge / glm::max(glm::ceil(frame.edge / widest - 1e-6), 1.0);
    return surface_voxels(world, mean_edge(spacing));
}

class DisplayCounter {
  public:
    DisplayCounter(const Device& device, const Scene& scene, const Pyramid& world,
                   const DensityPlan& medium, Estimate estimate)
        : device_(device),
          scene_(scene),
          world_(world),
          medium_(medium),
          frame_(display_frame(scene)),
          features_(volume_features(scene, world)),
          is_minimum_(estimate == Estimate::minimum) {}

    /// Returns the number of voxels that are shown.
    double run() { return frame_.layout == VolumeLayout::rays ? rays() : lattice(); }

  private:
    /// Follows VolumeRenderer in the layout `rays`.
    double rays() {
        const uint32_t tiles = tile_count(frame_.size.x, frame_.size.y), all = tiles * 16;
        const uint32_t in_batch = display_batch_tiles(device_, features_, tiles) * 16;
        const DisplayLight light =
            count_light(device_, scene_, features_, counts_of(in_batch), medium_);
        const auto of = dilation_that_pays(features_, world_, all, pixel_width());
        const DilatedOccupancy dilated_occupancy =
            of ? count_dilated_occupancy(device_, world_, *of) : DilatedOccupancy();
        const Buffer<uint32_t> beams = of ? allocate_beams(device_, in_batch) : Buffer<uint32_t>();
        const RayDepths kept = allocate_ray_depths(device_, features_, all);
        const Buffer<float> mean = count_mean(in_batch);
        // In a medium, each of a ray's steps in the world may show some of it.
        const double steps = features_.medium ? steps_in_world() : 1;
        const double shown = is_minimum_ ? 1 : steps * all;
        if (features_.transmission || features_.medium_grid) {
            const bool adds_layers = features_.transmission && !features_.own_light;
            const Buffer<float> seen(device_, "display layers",
                                     adds_layers ? size_t(in_batch) * 4 : 1);
            const LayerRays layers =
                features_.own_light ? allocate_layers(device_, features_, in_batch) : LayerRays();
            const Buffer<uint32_t> words(device_, "display layers",
                                         size_t(in_batch) * VXL_LAYER_WORDS);
            return shown;
        }
        const Buffer<uint32_t> starts(device_, "display counts",
                                      size_t(frame_.size.y) * size_t(frame_.size.z));
        allocate_voxels(device_, numbered(shown));
        return shown;
    }

    /// Counts the sums of the light of several paths.
    Buffer<float> count_mean(uint32_t rays) const {
        if (!features_.global || all_samples(scene_.render) == 1 ||
            is_sampled_by_noise(scene_.render) ||
            (features_.own_light && frame_.layout == VolumeLayout::rays))
            return {};
        return allocate_light_sums(device_, rays);
    }

    /// The mean number of a ray's steps in the world if nothing hides it.
    double steps_in_world() const {
        constexpr int kSamples = 24;  // along each axis
        const Bounds world = lattice_bounds(scene_.world);
        int inside = 0;
        for (int i = 0; i < kSamples * kSamples * kSamples; ++i) {
            const glm::ivec3 at(i % kSamples, i / kSamples % kSamples, i / kSamples / kSamples);
            const glm::dvec3 share = (glm::dvec3(at) + 0.5) / double(kSamples);
            const glm::dvec3 p = voxel_center(frame_, glm::ivec3(share * glm::dvec3(frame_.size)));
            inside += glm::all(glm::greaterThanEqual(p, world.min)) &&
                      glm::all(glm::lessThanEqual(p, world.max));
        }
        return frame_.size.z * double(inside) / (kSamples * kSamples * kSamples) + 1;
    }

    /// Follows VolumeRenderer in the layout `lattice`. All arrays stay, except the points that
    /// aren't shown.
    double lattice() {
        const Features features = begun_anywhere(features_, scene_);
        const uint32_t batch = batch_rays(device_, features);
        const DisplayLight light =
            count_light(device_, scene_, features, counts_of(batch), medium_);
        const std::optional<PathDepth> unlit = count_unlit(batch);
        const Buffer<float> mean = count_mean(batch);
        const Buffer<uint32_t> mask = allocate_display_mask(device_, frame_.size);
        const Buffer<float> crossings =
            allocate_crossings(device_, scanned_lines(batch), kFirstSlots);
        const Buffer<uint32_t> surfaces =
            features.transmission ? allocate_surfaces(device_, scanned_lines(batch), kFirstSlots)
                                  : Buffer<uint32_t>();
        const Buffer<uint32_t> lines(device_, "probe counts", scanned_lines(batch));
        const double found = is_minimum_ ? 16 : probe_points(frame_, world_);
        const double shown =
            is_minimum_ ? 16 : std::min(found, surface_voxels(world_, mean_edge(frame_.edge)));
        const ProbePoints points = allocate_points(device_, numbered(found));
        choose(numbered(shown), batch);
        return shown;
    }

    /// Counts the paths that determine only coverage.
    std::optional<PathDepth> count_unlit(uint32_t rays) const {
        if (!features_.transmission) return {};
        const Features features = coverage_features(unlit_scene(scene_), world_);
        return allocate_depth(device_, features, true, rays);
    }

    /// Counts the voxels of the medium that are measured together.
    void measure_medium() const {
        const Buffer<float> means = allocate_medium_means(device_, features_, frame_.size);
        const ProbePoints middles =
            allocate_points(device_, is_minimum_ ? 16 : medium_rows(frame_.size) * frame_.size.x);
    }

    /// Counts the voxels that are shown, and their points.
    void choose(uint32_t shown, uint32_t rays) const {
        const VoxelArrays voxels = allocate_voxels(device_, shown);
        const ProbePoints chosen = allocate_points(device_, shown);
        {
            const Buffer<uint32_t> distances(device_, "display distances", shown);
            const Buffer<uint32_t> numbers(device_, "display numbers", shown);
        }
        SampleSums sums;
        std::array<ProbePoints, 3> of_axes;
        if (all_samples(scene_.render) > 1) {
            for (ProbePoints& points : of_axes) points = allocate_points(device_, shown);
            sums = allocate_sample_sums(device_, shown, rays, all_samples(scene_.render),
                                        is_sampled_by_noise(scene_.render));
        }
        const Buffer<uint32_t> covers =
            features_.transmission ? allocate_covers(device_, shown) : Buffer<uint32_t>();
        if (features_.medium) measure_medium();
    }

    RayCounts counts_of(uint32_t rays) const {
        RayCounts counts = ray_counts(device_, scene_, features_);
        counts.rays = rays;
        if (is_minimum_) counts.depth = std::min<size_t>(counts.depth, 1);
        return counts;
    }

    double pixel_width() const {
        Scene scene = scene_;
        scene.render.size = {frame_.size.x, frame_.size.y};
        scene.render.crop = {};
        scene.render.samples = 1;
        return voxels_a_pixel(scene, camera_of(scene, world_.frame), world_.frame);
    }

    const Device& device_;
    const Scene& scene_;
    const Pyramid& world_;
    const DensityPlan& medium_;
    VolumeFrame frame_;
    Features features_;
    bool is_minimum_;
};

}  // namespace

double count_volume(const Device& device, const Scene& scene, const Pyramid& world,
                    const DensityPlan& medium, Estimate estimate) {
    const Scene shown = volume_scene(scene);
    return DisplayCounter(device, shown, world, medium, estimate).run();
}

}  // namespace voxelume
