// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/earlier_images.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <optional>

#include "runtime/api/frame_hash.hpp"
#include "runtime/api/render.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/scene/first_samples.hpp"
#include "runtime/scene/rendered_channels.hpp"

namespace voxelume::api {
namespace {

// The texts in an image's header that tell of its samples.
constexpr const char* kSamples = "samples";  ///< per pixel; with a target of noise the maximum
constexpr const char* kNoiseTarget = "noise target";
constexpr const char* kTimeTarget = "time target";

const char* by_noise(const RenderSettings& render) {
    return render.noise.is_given() ? "by noise or time" : "by their number";
}

void check_channels(const RenderSettings& render, const v1::Channels& channels) {
    if (channels.variance && !render.noise.is_given())
        throw Error(ErrorKind::usage,
                    "samples can't be added by their number where the image has channels variance: "
                    "ask for noise or time in both runs, or render it again from the start");
    if (channels.motion && !(channels.position && channels.object))
        throw Error(ErrorKind::usage,
                    "samples are added to channels motion only where P and objectId tell what "
                    "pixels show: ask for these, too");
    if (render.noise.is_given()) {
        if (channels.color && channels.samples && channels.noise) return;
        throw Error(ErrorKind::usage,
                    "samples are added by noise or time where the image has channels RGBA, samples "
                    "and noise, which tell what it lacks: ask for them, too");
    }
    if (shows_points_alone(inside(channels)))
        throw Error(ErrorKind::usage,
                    "samples are added to channels P only where Z, distance, N, objectId or "
                    "materialId tells which pixels show something: ask for one of them, too");
}

void check_job(const Scene& scene, const v1::FrameJob& job) {
    if (is_adaptive(scene.render))
        throw Error(ErrorKind::usage,
                    "{}: samples can't be added by contrast: leave render.adaptive out, or render "
                    "the image again from the start",
                    scene.file.string());
    if (!job.image_files.float_color)
        throw Error(
            ErrorKind::usage,
            "samples are added to images of 32-bit floats: ask for such of the earlier image "
            "and of this one (--float, float_color)");
    for (const v1::FrameFiles& frame : job.frames)
        if (!frame.earlier.empty() && !frame.volumes.empty())
            throw Error(
                ErrorKind::usage,
                "samples are added to flat images alone: render volumetric images again from the "
                "start");
}

/// A number in an image's header.
template <class Number>
std::optional<Number> number_in(const ExrHeader& header, const char* attribute) {
    const auto found = header.attributes.find(attribute);
    if (found == header.attributes.end()) return std::nullopt;
    Number number{};
    const char *begin = found->second.data(), *end = begin + found->second.size();
    if (std::from_chars(begin, end, number).ptr != end) return std::nullopt;
    return number;
}

/// The sampling of an image, as its file's header gives it.
RenderSettings sampling_in(const std::filesystem::path& file) {
    const ExrHeader header = read_exr_header(file);
    RenderSettings render;
    const std::optional<int> samples = number_in<int>(header, kSamples);
    if (!samples || *samples < 1)
        throw Error(
            ErrorKind::input,
            "{}: doesn't say how many samples its pixels have, so none can be added: render "
            "it again from the start",
            file.string());
    render.samples = *samples;
    render.noise = {number_in<double>(header, kNoiseTarget).value_or(0),
                    number_in<double>(header, kTimeTarget).value_or(0)};
    return render;
}

/// Throws for images with all samples that are wanted, and others to which none can be added.
void check_samples(const std::filesystem::path& file, const RenderSettings& earlier,
                   const RenderSettings& wanted) {
    if (earlier.noise.is_given() != wanted.noise.is_given())
        throw Error(ErrorKind::usage,
                    "{}: has samples {}, and others are asked for {}: render it again "
                    "from the start, or ask alike",
                    file.string(), by_noise(earlier), by_noise(wanted));
    if (earlier.noise.is_given()) {
        if (wanted.noise.error <= earlier.noise.error && wanted.samples >= earlier.samples) return;
        if (earlier.noise.error == 0)
            throw Error(ErrorKind::usage,
                        "{}: was rendered by time alone, with at most {} samples; ask for time "
                        "alone, and no fewer samples",
                        file.string(), earlier.samples);
        throw Error(
            ErrorKind::usage,
            "{}: was rendered to a noise of {} by at most {} samples; ask for no more noise "
            "and no fewer samples",
            file.string(), earlier.noise.error, earlier.samples);
    }
    if (earlier.samples >= wanted.samples)
        throw Error(ErrorKind::usage, "{}: has {} samples a pixel, and {} are asked for",
                    file.string(), earlier.samples, wanted.samples);
    if (!std::has_single_bit(unsigned(earlier.samples)))
        throw Error(ErrorKind::input,
                    "{}: has {} samples a pixel, whose sums its means don't give exactly: only to "
                    "1, 2, 4, 8, ... can others be added",
                    file.string(), earlier.samples);
}

/// The scene with the sampling of an earlier run.
v1::Scene sampled(const v1::Scene& scene, const RenderSettings& as) {
    if (as.noise.is_given()) return scene.with_noise(as.noise.error, as.noise.seconds, as.samples);
    return scene.with_samples(as.samples);
}

}  // namespace

Attributes sampling_texts(const Scene& scene) {
    const RenderSettings& render = scene.render;
    if (is_adaptive(render)) return {};
    Attributes texts{{kSamples, std::to_string(render.samples)}};
    if (render.noise.is_given()) {
        texts[kNoiseTarget] = fmt::format("{}", render.noise.error);
        texts[kTimeTarget] = fmt::format("{}", render.noise.seconds);
    }
    return texts;
}

EarlierFiles::EarlierFiles(const v1::Scene& scene, const v1::FrameJob& job,
                           const v1::Channels& channels) {
    const RenderSettings& wanted = inside(scene).render;
    std::optional<FrameHashes> hashes;
    std::optional<RenderSettings> of_hashes;
    for (const v1::FrameFiles& frame : job.frames) {
        if (frame.earlier.empty()) continue;
        if (files_.empty()) {
            check_job(inside(scene), job);
            check_channels(wanted, channels);
        }
        const RenderSettings earlier = sampling_in(frame.earlier);
        check_samples(frame.earlier, earlier, wanted);
        if (of_hashes != earlier) hashes.emplace(sampled(scene, earlier));
        of_hashes = earlier;
        const std::string hash =
            hash_for_image(hashes->of(frame.frame), *image_format_of(".exr"), job.image_files);
        const StampState state = check_stamp(frame.earlier, hash);
        if (state != StampState::current)
            throw Error(ErrorKind::input,
                        "{}: {}, so no samples can be added to it: render it again from the "
                        "start",
                        frame.earlier.string(),
                        state == StampState::stale
                            ? "was made from another scene, frame, option or version"
                            : "isn't as it was written");
        files_[frame.frame] = {frame.earlier, earlier.noise.is_given() ? 0 : earlier.samples};
    }
}

EarlierImages EarlierFiles::images() const {
    if (files_.empty()) return {};
    return [files = files_](int frame) -> EarlierImage {
        const auto found = files.find(frame);
        if (found == files.end()) return {};
        const auto& [path, samples] = found->second;
        return {std::make_shared<const Image>(read_exr(path)), samples};
    };
}

}  // namespace voxelume::api
