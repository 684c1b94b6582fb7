// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/shutter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/scene_motion.hpp"

namespace voxelume {
namespace {

/// The bits of a number in reverse, as a binary fraction.
double radical_inverse(uint32_t number) {
    double fraction = 0;
    for (double bit = 0.5; number != 0; number >>= 1, bit /= 2)
        if (number & 1) fraction += bit;
    return fraction;
}

/// True if a track has no key between two frames, nor keys on both sides of them.
bool has_no_key_around(const Keyframes& keys, double from, double to) {
    return to <= keys.frames.front() || from >= keys.frames.back();
}

/// True if all moments of a frame are known to be equal, without looking at each.
bool stands_still(const Scene& scene, double frame) {
    if (!has_moments(scene)) return true;
    const double end = frame + scene.observer.shutter;
    return !any_part_changes(scene, [&](const MovingPart& part) {
        return !part.sequences.empty() || std::ranges::any_of(part.tracks, [&](const Track& track) {
            return !has_no_key_around(track.keys, frame, end);
        });
    });
}

}  // namespace

bool has_moments(const Scene& scene) {
    const RenderSettings& render = scene.render;
    return moves(scene) && scene.observer.shutter > 0 && render.shows_image &&
           render.first_sample + render.samples > 1;
}

double moment_of(const Scene& scene, double frame, int sample) {
    return frame + scene.observer.shutter * radical_inverse(uint32_t(sample));
}

std::vector<double> moments_of(const Scene& scene, double frame) {
    if (stands_still(scene, frame)) return {frame};
    std::vector<double> moments;
    const RenderSettings& render = scene.render;
    for (int sample = render.first_sample; sample < render.first_sample + render.samples; ++sample)
        moments.push_back(moment_of(scene, frame, sample));
    std::ranges::sort(moments);
    return moments;
}

std::vector<double> some_moments_of(const Scene& scene, double frame) {
    std::vector<double> all = moments_of(scene, frame);
    if (all.size() < 3) return all;
    return {all.front(), all[all.size() / 2], all.back()};
}

size_t worlds_of(const Scene& scene, size_t frames) {
    return has_moments(scene) ? std::max<size_t>(frames, 2) : frames;
}

int samples_at_once(const Scene& scene, double frame) {
    const int first = scene.render.first_sample, samples = scene.render.samples;
    if (stands_still(scene, frame)) return samples;
    int maximum = 0, row = 0;
    Scene shown = scene_at(scene, moment_of(scene, frame, first));
    for (int sample = first; sample < first + samples; ++sample) {
        Scene now = scene_at(scene, moment_of(scene, frame, sample));
        row = now == shown ? row + 1 : 1;
        maximum = std::max(maximum, row);
        shown = std::move(now);
    }
    return maximum;
}

bool is_blurred(const Scene& scene, double frame) {
    if (stands_still(scene, frame)) return false;
    const std::vector<double> moments = moments_of(scene, frame);
    const Scene first = scene_at(scene, moments.front());
    return std::ranges::any_of(moments,
                               [&](double moment) { return scene_at(scene, moment) != first; });
}

}  // namespace voxelume
