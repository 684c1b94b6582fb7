// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/gltf/gltf_animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "runtime/io/gltf/gltf_accessor.hpp"

namespace voxelume {
namespace {

struct Path {
    std::string_view name;
    GltfPath path;
    int components;  ///< number of its accessor's components
};

constexpr std::array<Path, 4> kPaths = {{{"translation", GltfPath::translation, 3},
                                         {"rotation", GltfPath::rotation, 4},
                                         {"scale", GltfPath::scale, 3},
                                         {"weights", GltfPath::weights, 1}}};

Interpolation interpolation_of(const GltfValue& sampler, bool is_rotation) {
    const std::string name = sampler.text("interpolation", "LINEAR");
    if (name == "STEP") return Interpolation::step;
    if (name == "CUBICSPLINE") return Interpolation::spline;
    if (name != "LINEAR") sampler.fail(fmt::format("{} is no interpolation", name));
    return is_rotation ? Interpolation::slerp : Interpolation::linear;
}

/// Takes the times of a sampler's keys.
void read_times(const GltfFile& file, const GltfValue& sampler, Keyframes& keys) {
    const GltfValues times = gltf_values(file, sampler, "input", {1});
    for (const float time : times.values) {
        if (!std::isfinite(time) || std::abs(time) > 1e6F)
            sampler.fail("a key's time isn't a number of at most a million seconds");
        if (!keys.frames.empty() && !(time > keys.frames.back()))
            sampler.fail(
                fmt::format("a key at {} s comes after one at {} s", time, keys.frames.back()));
        keys.frames.push_back(double(time));
    }
}

/// Takes the values of a sampler's keys, between their slopes where it is a spline.
void read_values(const GltfFile& file, const GltfValue& sampler, int components, Keyframes& keys) {
    const GltfValues output = gltf_values(file, sampler, "output", {components});
    const size_t count = keys.frames.size();
    const size_t parts = keys.interpolation == Interpolation::spline ? 3 : 1;
    const size_t all = output.values.size();
    keys.width = components == 1 ? all / (count * parts) : size_t(components);
    if (keys.width == 0 || all != keys.width * count * parts)
        sampler.fail(fmt::format("{} keys, and {} values", count, output.count));
    if (!std::ranges::all_of(output.values, [](float v) { return std::abs(v) <= 1e9F; }))
        sampler.fail("a value isn't a number of at most 1e9");
    const auto append = [&](size_t key, size_t part, std::vector<double>& to) {
        const auto first =
            output.values.begin() + std::ptrdiff_t((key * parts + part) * keys.width);
        to.insert(to.end(), first, first + std::ptrdiff_t(keys.width));
    };
    for (size_t key = 0; key < count; ++key) {
        append(key, parts / 2, keys.values);
        if (parts == 1) continue;
        append(key, 0, keys.in);
        append(key, 2, keys.out);
    }
}

/// The track of a channel; empty for one that changes nothing that is known.
std::optional<GltfTrack> track_of(const GltfFile& file, const GltfValue& animation,
                                  const GltfValue& channel) {
    const GltfValue target = channel.at("target");
    const auto* const path = std::ranges::find(kPaths, target.text("path"), &Path::name);
    GltfTrack track;
    track.node = target.index("node", file.root().size("nodes"));
    if (path == kPaths.end() || track.node < 0) return {};
    track.path = path->path;
    const int number = channel.index("sampler", animation.size("samplers"));
    if (number < 0) channel.fail("has no sampler");
    const GltfValue sampler = animation.item("samplers", size_t(number));
    track.keys.has_quaternions = track.path == GltfPath::rotation;
    track.keys.interpolation = interpolation_of(sampler, track.keys.has_quaternions);
    read_times(file, sampler, track.keys);
    read_values(file, sampler, path->components, track.keys);
    for (size_t i = 0; track.keys.has_quaternions && i < track.keys.values.size(); i += 4)
        if (std::all_of(&track.keys.values[i], &track.keys.values[i] + 4,
                        [](double v) { return v == 0; }))
            sampler.fail("a rotation is [0, 0, 0, 0], which is none");
    return track;
}

}  // namespace

std::vector<std::string> gltf_clip_names(const GltfFile& file) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (const GltfValue& animation : file.root().items("animations")) {
        std::string name = animation.text("name");
        if (name.empty()) name = fmt::format("clip {}", names.size() + 1);
        while (!taken.insert(name).second) name += fmt::format(" {}", names.size() + 1);
        names.push_back(std::move(name));
    }
    return names;
}

GltfClip gltf_clip(const GltfFile& file, size_t number) {
    const GltfValue animation = file.root().item("animations", number);
    GltfClip clip;
    clip.name = gltf_clip_names(file)[number];
    std::set<std::pair<int, GltfPath>> taken;
    for (const GltfValue& channel : animation.items("channels")) {
        std::optional<GltfTrack> track = track_of(file, animation, channel);
        if (!track) continue;
        if (!taken.insert({track->node, track->path}).second)
            channel.fail("changes what another channel changes already");
        clip.seconds = std::max(clip.seconds, track->keys.frames.back());
        clip.tracks.push_back(std::move(*track));
    }
    return clip;
}

}  // namespace voxelume
