// SPDX-License-Identifier: Apache-2.0
// An image with as many samples as its scene says, or as each of its tiles needs.
//
// The samples of a tile are doubled until the two halves of them agree. A tile's bits depend on no
// other tile, so neither devices nor threads change them.
#include <algorithm>
#include <chrono>

#include "runtime/render/renderer.hpp"

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

/// Those of the tiles that something is true of.
template <class IsTrue>
std::vector<TileRange> tiles_where(const std::vector<TileRange>& tiles, IsTrue&& is_true) {
    std::vector<TileRange> result;
    for (const TileRange& range : tiles)
        for (uint32_t tile = range.first; tile < range.first + range.count; ++tile)
            if (is_true(tile)) add_tile(tile, result);
    return result;
}

}  // namespace

/// An image with the samples of each tile that are given, or, if none are, with those that it
/// needs, which it gives.
Image Renderer::sampled_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                              const Tiles& tiles, std::vector<int>& samples) {
    const NoiseTarget target = scene.render.noise;
    if (!target.is_given()) return image_of_tiles(scene, world, report, tiles);
    const auto start = Clock::now();
    Scene part = scene;
    part.render.noise = {};
    part.render.samples = std::min(kFirstSamples, scene.render.samples);
    Image image = image_of_tiles(part, world, report, tiles);
    if (!scene.render.channels.color) return image;
    const bool is_measured = samples.empty();
    if (is_measured) samples.assign(tiles.share.tiles(), part.render.samples);
    const auto has_more = [&](uint32_t tile) {
        return is_measured || samples[tile] > part.render.samples;
    };
    std::vector<TileRange> left = tiles_where(tiles.taken, has_more);
    part.render.channels = kColorAlone;  // others are undefined in tiles that aren't rendered again
    std::vector<float> errors(tiles.share.tiles(), -1.0f);
    for (int done = part.render.samples; !left.empty() && 2 * done <= scene.render.samples;
         done *= 2) {
        if (is_measured && !has_time(target, start)) break;
        part.render.first_sample = part.render.samples = done;
        RenderReport of_more;
        TileShare share(tiles.share, left);
        std::vector<TileRange> taken;
        Renderer renderer(device_, false);
        renderer.is_white_ = is_white_;
        const Image more = renderer.image_of_tiles(part, world, of_more, {share, taken});
        if (tiles.share.is_closed()) break;
        left = tiles_where(left, [&](uint32_t tile) {
            const auto [error, is_dark] = average_tile(tile, more, image);
            errors[tile] = float(error);
            if (!is_measured) return samples[tile] > 2 * done;
            samples[tile] = 2 * done;
            return error > target.error || (is_dark && 2 * done < kDarkSamples);
        });
        add_counts(of_more, report);
        report.image_seconds += of_more.image_seconds;
    }
    for (const float error : errors) {
        if (error < 0) continue;
        report.noise.squares += double(error) * double(error);
        ++report.noise.tiles;
    }
    return image;
}

}  // namespace voxelume
