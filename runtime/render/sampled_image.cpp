// SPDX-License-Identifier: Apache-2.0
// An image with as many samples as its scene says, or as each of its tiles needs.
//
// The samples of a tile are doubled until the two halves of them agree. A tile's bits depend on no
// other tile, so neither devices nor threads change them.
#include <algorithm>
#include <chrono>
#include <utility>

#include "runtime/render/renderer.hpp"
#include "runtime/scene/first_samples.hpp"

namespace voxelume {
namespace {

using Clock = std::chrono::steady_clock;

/// The number of samples by which two halves are first compared.
constexpr int kFirstSamples = 16;

/// The number of samples by which a tile of surfaces counts as dark: few paths may find its light.
constexpr int kDarkSamples = 256;

/// Colours, and no other channel.
constexpr ImageChannels kColorAlone = {true, false, false, false, false};

/// Adds a tile to those that ranges hold, in order.
void add_tile(uint32_t tile, std::vector<TileRange>& ranges) {
    if (!ranges.empty() && ranges.back().first + ranges.back().count == tile)
        ++ranges.back().count;
    else
        ranges.push_back({tile, 1});
}

/// Whether there is time for as much again as was spent since the start.
bool has_time(const NoiseTarget& target, Clock::time_point start) {
    const std::chrono::duration<double> spent = Clock::now() - start;
    return target.seconds == 0 || 2 * spent.count() <= target.seconds;
}

/// Whether an image's tiles may need more samples than its first ones.
bool is_sampled_again(const Scene& scene) {
    return scene.render.noise.is_given() && scene.render.channels.color;
}

uint32_t count_of(const std::vector<TileRange>& tiles) {
    uint32_t count = 0;
    for (const TileRange& range : tiles) count += range.count;
    return count;
}

/// Those of the tiles that something is true of.
template <class IsTrue>
std::vector<TileRange> tiles_where(const std::vector<TileRange>& tiles, IsTrue&& is_true) {
    std::vector<TileRange> result;
    for (const TileRange& range : tiles)
        for (uint32_t tile = range.first; tile < range.first + range.count; ++tile)
            if (is_true(tile)) add_tile(tile, result);
    return result;
}

/// Tells of an image's work, of which tiles may end before they have all samples.
class SampledWork {
  public:
    SampledWork(const Renderer::Tiles& tiles, int max_samples)
        : share_(tiles.share),
          max_samples_(max_samples),
          per_sample_(tiles.weight / double(max_samples)) {}

    /// Of one tile's samples.
    double weight(int samples) const { return per_sample_ * samples; }

    /// Tells that tiles, but for those that are left, have `samples` and need no more.
    void end(const std::vector<TileRange>& tiles, const std::vector<TileRange>& left, int samples) {
        share_.add_work((count_of(tiles) - count_of(left)) * weight(max_samples_ - samples));
    }

  private:
    TileShare& share_;
    int max_samples_;
    double per_sample_;
};

}  // namespace

/// The weight of what is rendered first, of an image's work: with a target of noise it is a part of
/// the samples that tiles may need.
double Renderer::first_weight(const Scene& scene, double weight) {
    if (!is_sampled_again(scene)) return weight;
    return weight * std::min(kFirstSamples, scene.render.samples) / scene.render.samples;
}

/// An image with the samples of each tile, or of each pixel, that are given, or, if none are, with
/// those that it needs, which it gives.
Image Renderer::sampled_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                              const Tiles& tiles, Sampled& sampled) {
    if (is_adaptive(scene.render)) return adaptive_image(scene, world, report, tiles, sampled);
    const NoiseTarget target = scene.render.noise;
    if (!target.is_given()) return image_of_tiles(scene, world, report, tiles);
    const auto start = Clock::now();
    Scene part = scene;
    part.render.noise = {};
    part.render.samples = std::min(kFirstSamples, scene.render.samples);
    Image image = image_of_tiles(part, world, report, tiles);
    if (!is_sampled_again(scene)) return image;
    std::vector<int>& samples = sampled.tiles;
    const bool is_measured = samples.empty();
    if (is_measured) samples.assign(tiles.share.tiles(), part.render.samples);
    const auto has_more = [&](uint32_t tile) {
        return is_measured || samples[tile] > part.render.samples;
    };
    std::vector<TileRange> left = tiles_where(tiles.taken, has_more);
    SampledWork work(tiles, scene.render.samples);
    work.end(tiles.taken, left, part.render.samples);
    int reached = part.render.samples;
    part.render.channels = kColorAlone;  // others are undefined in tiles that aren't rendered again
    std::vector<float> errors(tiles.share.tiles(), -1.0f);
    for (int done = part.render.samples; !left.empty() && 2 * done <= scene.render.samples;
         done *= 2) {
        if (is_measured && !has_time(target, start)) break;
        part.render.first_sample = part.render.samples = done;
        RenderReport of_more;
        TileShare share(tiles.share, left, work.weight(done));
        std::vector<TileRange> taken;
        Renderer renderer(device_, false);
        renderer.is_white_ = is_white_;
        const Image more = renderer.image_of_tiles(part, world, of_more, {share, taken});
        if (tiles.share.is_closed()) break;
        reached = 2 * done;
        const std::vector<TileRange> again = std::exchange(left, {});
        left = tiles_where(again, [&](uint32_t tile) {
            const auto [error, is_dark] = average_tile(tile, more, image);
            errors[tile] = float(error);
            if (!is_measured) return samples[tile] > 2 * done;
            samples[tile] = 2 * done;
            return error > target.error || (is_dark && 2 * done < kDarkSamples);
        });
        work.end(again, left, reached);
        add_counts(of_more, report);
        report.image_seconds += of_more.image_seconds;
    }
    work.end(left, {}, reached);
    for (const float error : errors) {
        if (error < 0) continue;
        report.noise.squares += double(error) * double(error);
        ++report.noise.tiles;
    }
    return image;
}

}  // namespace voxelume
