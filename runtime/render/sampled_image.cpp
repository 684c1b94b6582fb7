// SPDX-License-Identifier: Apache-2.0
// An image with as many samples as its scene says, or as each of its tiles needs.
//
// The samples of a tile are doubled until the two halves of them agree. A tile's bits depend on no
// other tile, so neither devices nor threads change them.
#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/image/cryptomatte.hpp"
#include "runtime/render/light_passes.hpp"
#include "runtime/render/noise.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene/first_samples.hpp"
#include "runtime/scene/rendered_channels.hpp"

namespace voxelume {
namespace {

/// The channels of an image that are averaged.
ImageChannels averaged(const ImageChannels& asked) {
    return {.color = true,
            .depth = false,
            .position = false,
            .normal = false,
            .object = false,
            .variance = asked.variance};
}

/// True if an image's tiles may need more samples after the first ones.
bool is_sampled_again(const Scene& scene) {
    return scene.render.noise.is_given() && scene.render.channels.color;
}

/// Refines a sixteenth of some tiles to see how long the rest would take: nothing is known of that
/// where an earlier run made the samples. True if the target has time for the rest, in `tiles`.
template <class Refine>
bool has_time_for_rest(std::vector<TileRange>& tiles, const NoiseTarget& target,
                       NoiseClock::time_point start, Refine&& refine) {
    const std::vector<TileRange> few = take_sixteenth(tiles);
    const auto begin = NoiseClock::now();
    if (!refine(few)) return false;
    const auto now = NoiseClock::now();
    const std::chrono::duration<double> spent = now - start, of_few = now - begin;
    return spent.count() + of_few.count() * count_tiles(tiles) / count_tiles(few) <= target.seconds;
}

/// The numbers of samples of an image's tiles.
class TileSamples {
  public:
    /// All tiles have `first` samples, and get at most `maximum`.
    TileSamples(uint32_t tiles, int first, int maximum)
        : first_(first), maximum_(maximum), samples_(tiles, first), errors_(tiles, INFINITY) {}

    int of(uint32_t tile) const { return samples_[tile]; }

    /// True if a measured tile needs twice the samples.
    bool needs_more(uint32_t tile, const NoiseTarget& target, const Image& image) const {
        const int samples = samples_[tile];
        if (2 * samples > maximum_) return false;
        return errors_[tile] > target.error ||
               (samples < kDarkSamples && is_dark_tile(tile, image));
    }

    void set(uint32_t tile, int samples, double error) {
        samples_[tile] = samples;
        errors_[tile] = float(error);
    }

    /// Takes a tile's state from the channels of an image of an earlier run.
    void set_from(uint32_t tile, const Image& image) {
        const size_t at = size_t(int(tile) / tiles_across(image) * 4) * size_t(image.width) +
                          size_t(int(tile) % tiles_across(image) * 4);
        const float samples = image.planes.at("samples")[at], error = image.planes.at("noise")[at];
        int level = first_;
        while (2 * level <= maximum_ && float(level) != samples) level *= 2;
        if (float(level) != samples || !(error >= 0))
            throw Error(ErrorKind::input,
                        "the image to which samples are added has {} samples and a noise of {} in "
                        "a tile, which no image has",
                        samples, error);
        set(tile, level, double(error));
    }

    /// Sums up the errors of tiles that were measured.
    NoiseReached reached(const std::vector<TileRange>& tiles) const {
        NoiseReached sum;
        for_each_tile(tiles, [&](uint32_t tile) {
            if (std::isfinite(errors_[tile])) sum.add(double(errors_[tile]));
        });
        return sum;
    }

    /// Copies the numbers of some tiles.
    void give(const std::vector<TileRange>& tiles, std::vector<int>& samples) const {
        samples.resize(samples_.size());
        for_each_tile(tiles, [&](uint32_t tile) { samples[tile] = samples_[tile]; });
    }

    /// Writes the channels of samples and noise.
    void show(const ImageChannels& channels, Image& image) const {
        if (channels.samples)
            show(image, "samples", [this](size_t tile) { return float(samples_[tile]); });
        if (channels.noise) show(image, "noise", [this](size_t tile) { return errors_[tile]; });
    }

  private:
    static int tiles_across(const Image& image) { return (image.width + 3) / 4; }

    template <class Value>
    void show(Image& image, const char* name, Value&& value) const {
        std::vector<float> plane(size_t(image.width) * size_t(image.height));
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                plane[size_t(y) * size_t(image.width) + size_t(x)] =
                    value(size_t(y / 4) * size_t(tiles_across(image)) + size_t(x / 4));
        image.planes[name] = std::move(plane);
    }

    int first_, maximum_;
    std::vector<int> samples_;
    std::vector<float> errors_;  ///< infinite for tiles that aren't measured
};

/// The image `earlier` without its channels of samples and noise. Throws Error::input if it lacks
/// the colour that `channels` have.
Image planes_of(const Image& earlier, const ImageChannels& channels) {
    Image image = earlier;
    std::erase_if(image.planes, [](const auto& plane) {
        return plane.first == "samples" || plane.first == "noise";
    });
    std::erase_if(image.attributes,
                  [](const auto& text) { return !text.first.starts_with(kMatteKey); });
    for (const char* name : {"R", "G", "B", "A"})
        if (channels.color && !image.planes.contains(name))
            throw Error(ErrorKind::input, "the image to which samples are added has no channel {}",
                        name);
    return image;
}

/// The scene with that many samples, whatever its noise.
Scene without_target(const Scene& scene, int samples) {
    Scene part = scene;
    part.render.scatters_samples = has_scattered_samples(part.render);
    part.render.noise = {};
    part.render.earlier = {};
    part.render.samples = samples;
    return part;
}

/// Takes all remaining tiles, for which nothing is to be done.
void take_all(const Renderer::Tiles& tiles) {
    while (const std::optional<TileRange> range = tiles.share.take(tiles.share.maximum())) {
        tiles.taken.push_back(*range);
        tiles.share.done(*range);
    }
}

/// The image of an earlier run, with the state of its tiles, which all count as taken.
Image earlier_image(const RenderSettings& asked, const Renderer::Tiles& tiles, TileSamples& state) {
    Image image = planes_of(*asked.earlier, asked.channels);
    take_all(tiles);
    for_each_tile(tiles.taken, [&](uint32_t tile) { state.set_from(tile, *asked.earlier); });
    return image;
}

}  // namespace

bool measures_noise(const Scene& scene) {
    const RenderSettings& render = scene.render;
    return render.noise.is_given() && (render.channels.color || adds_color(render)) &&
           render.samples >= 2 * std::min(kFirstSamples, render.samples);
}

/// The weight of the first samples in an image's work: with a target of noise they are a part of
/// the samples that tiles may need.
double Renderer::first_weight(const Scene& scene, double weight) {
    if (!is_sampled_again(scene)) return weight;
    return weight * std::min(kFirstSamples, scene.render.samples) / scene.render.samples;
}

/// An image with the given numbers of samples of each tile or pixel in `sampled`. Without these, it
/// chooses the numbers and returns them in `sampled`.
Image Renderer::sampled_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                              const Tiles& tiles, Sampled& sampled) {
    if (is_adaptive(scene.render)) return adaptive_image(scene, world, report, tiles, sampled);
    if (scene.render.noise.is_given())
        return noisy_image(scene, world, report, tiles, sampled.tiles);
    Image image = image_of_tiles(scene, world, report, tiles);
    const int earlier = scene.render.earlier ? scene.render.first_sample : 0;
    const int samples = earlier + scene.render.samples;
    const ImageChannels& channels = scene.render.channels;
    if (channels.samples || channels.noise)
        TileSamples(tiles.share.tiles(), samples, samples).show(channels, image);
    return image;
}

/// An image whose tiles have the numbers of samples in `given`. If that is empty, tiles have as
/// many as they need, and `given` returns the numbers.
Image Renderer::noisy_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                            const Tiles& tiles, std::vector<int>& given) {
    const auto start = NoiseClock::now();
    const RenderSettings& asked = scene.render;
    const int maximum = asked.samples, first = std::min(kFirstSamples, maximum);
    const double per_sample = tiles.weight / double(maximum);
    Scene part = without_target(scene, first);
    TileSamples state(tiles.share.tiles(), first, maximum);
    Image image = asked.earlier ? earlier_image(asked, tiles, state)
                                : image_of_tiles(part, world, report, tiles);
    const bool is_measured = given.empty();
    const auto needs_more = [&](uint32_t tile) {
        return is_measured ? state.needs_more(tile, asked.noise, image)
                           : given[tile] > state.of(tile);
    };
    std::vector<int> told(tiles.share.tiles(), first);  // samples that the share was told of
    const auto tell_of_all = [&](uint32_t tile) {
        tiles.share.add_work(per_sample * (maximum - std::exchange(told[tile], maximum)));
    };
    // Only these channels are averaged. Tiles that aren't rendered again are undefined in `more`.
    part.render.channels = averaged(asked.channels);
    // Doubles the samples of tiles that have `done` of them. False once nothing is to be done.
    const auto refine = [&](const std::vector<TileRange>& left, int done) {
        part.render.first_sample = part.render.samples = done;
        TileShare share(tiles.share, left, per_sample * done);
        std::vector<TileRange> taken;
        RenderReport of_more;
        const Image more = more_samples(part, world, of_more, {share, taken});
        if (tiles.share.is_closed()) return false;
        for_each_tile(left, [&](uint32_t tile) {
            state.set(tile, 2 * done, average_tile(tile, done, more, image));
            told[tile] += done;
            if (!needs_more(tile)) tell_of_all(tile);
        });
        add_counts(of_more, report);
        report.moments += of_more.moments;
        report.image_seconds += of_more.image_seconds;
        return true;
    };
    bool is_untimed = is_measured && asked.earlier && asked.noise.seconds > 0;
    for (int done = first; is_sampled_again(scene) && 2 * done <= maximum; done *= 2) {
        std::vector<TileRange> left = tiles_where(
            tiles.taken, [&](uint32_t tile) { return state.of(tile) == done && needs_more(tile); });
        if (left.empty()) continue;
        if (is_measured && !has_time(asked.noise, start)) break;
        const auto refine_few = [&](const auto& few) { return refine(few, done); };
        if (std::exchange(is_untimed, false) &&
            !has_time_for_rest(left, asked.noise, start, refine_few))
            break;
        if (!left.empty() && !refine(left, done)) break;
    }
    if (is_sampled_again(scene)) for_each_tile(tiles.taken, tell_of_all);
    if (is_measured && is_sampled_again(scene)) {
        state.give(tiles.taken, given);
        report.noise = state.reached(tiles.taken);
    }
    state.show(asked.channels, image);
    return image;
}

/// More samples of tiles, by a renderer that retains nothing of them.
Image Renderer::more_samples(const Scene& part, const BuiltWorld& world, RenderReport& report,
                             const Tiles& tiles) const {
    Renderer renderer(device_, false);
    renderer.is_white_ = is_white_;
    renderer.show_moments_of(*this, pass_);
    return renderer.image_of_tiles(part, world, report, tiles);
}

}  // namespace voxelume
