// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/volume_samples.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace voxelume {
namespace {

constexpr uint32_t kGroup = 16;
constexpr double kNoTime = 1e-9;  ///< seconds; 0 stands for unlimited time

/// The means of the light of rays, four numbers each.
using Means = std::vector<float>;

double weight(const Means& means, size_t ray) {
    return double(means[4 * ray + 3]);
}

/// The luminance of a ray whose weight isn't 0.
double light_of(const Means& means, size_t ray) {
    const float* const c = &means[4 * ray];
    return luminance(double(c[0]), double(c[1]), double(c[2])) / weight(means, ray);
}

/// Calls `see` with the rays of a group.
template <class See>
void for_each_ray(uint32_t group, const Means& means, See&& see) {
    const size_t end = std::min<size_t>(size_t(group + 1) * kGroup, means.size() / 4);
    for (size_t ray = size_t(group) * kGroup; ray < end; ++ray) see(ray);
}

/// What a group shows.
struct Shown {
    bool nothing = true, dark = true;
};

Shown shown_by(uint32_t group, const Means& means) {
    Shown shown;
    for_each_ray(group, means, [&](size_t ray) {
        if (!(weight(means, ray) > 0)) return;
        shown.nothing = false;
        shown.dark &= !(light_of(means, ray) > 0);
    });
    return shown;
}

/// Averages a group over two means of as many samples, in `means`. Returns the standard error of
/// its rays' light over their mean.
double average_group(uint32_t group, const Means& more, Means& means) {
    ErrorOfHalves error;
    for_each_ray(group, means, [&](size_t ray) {
        const bool both = weight(means, ray) > 0 && weight(more, ray) > 0;
        const double half = both ? 0.5 * (light_of(means, ray) - light_of(more, ray)) : 0;
        for (size_t i = 4 * ray; i < 4 * ray + 4; ++i) means[i] = 0.5f * (means[i] + more[i]);
        if (both) error.add(half, light_of(means, ray));
    });
    return error.relative();
}

}  // namespace

SamplesByNoise::SamplesByNoise(const RenderSettings& render, uint64_t rays)
    : target_(render.noise),
      maximum_(render.samples),
      seconds_left_(render.noise.seconds * time_share(render)),
      rays_left_(rays) {}

std::vector<float> SamplesByNoise::mean(uint32_t rays, uint32_t aimed, const LightSamples& light) {
    const auto start = NoiseClock::now();
    NoiseTarget target = target_;
    if (target.seconds > 0) {
        const double part = double(aimed) / double(std::max<uint64_t>({rays_left_, aimed, 1}));
        target.seconds = std::max(seconds_left_ * part, kNoTime);
    }
    rays_left_ -= std::min<uint64_t>(rays_left_, aimed);
    const uint32_t groups = (rays + kGroup - 1) / kGroup;
    std::vector<uint32_t> wanted(groups, 1);
    std::vector<double> errors(groups, std::numeric_limits<double>::infinity());
    Means means = light(0, kFirstSamples, wanted);
    const auto needs_more = [&](uint32_t group, int samples) {
        const Shown shown = shown_by(group, means);
        return !shown.nothing &&
               (errors[group] > target.error || (shown.dark && samples < kDarkSamples));
    };
    for (int done = kFirstSamples; 2 * done <= maximum_; done *= 2) {
        for (uint32_t group = 0; group < groups; ++group)
            if (wanted[group] && !needs_more(group, done)) wanted[group] = 0;
        if (std::ranges::none_of(wanted, [](uint32_t is_wanted) { return is_wanted; })) break;
        if (!has_time(target, start)) break;
        const Means more = light(uint32_t(done), uint32_t(done), wanted);
        for (uint32_t group = 0; group < groups; ++group)
            if (wanted[group]) errors[group] = average_group(group, more, means);
    }
    for (const double error : errors)
        if (std::isfinite(error)) reached_.add(error);
    seconds_left_ -= std::chrono::duration<double>(NoiseClock::now() - start).count();
    return means;
}

}  // namespace voxelume
