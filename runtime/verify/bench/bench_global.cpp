// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench_global.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/analysis/culling.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/world/world.hpp"

namespace voxelume {

/// The text of scenes/cornell.json at the time when the program was built.
std::string_view cornell_text();

namespace {

constexpr const char* kColors[] = {"R", "G", "B"};

/// The number of the first sample of the references; the second one begins at twice this number.
/// Sequences of samples are shuffled in blocks of powers of two, so these samples are independent
/// of the first block.
constexpr int kFirstOfReferences = 1 << 20;

/// Each reference has at least this many samples, and twice as many as any row, but no more than a
/// scene may have.
constexpr int kMinReferenceSamples = 64;
constexpr int kMaxSamples = 4096;

Scene cornell_scene(glm::ivec2 size) {
    Scene scene = parse_scene(cornell_text(), "cornell.json", {});
    resize(scene, size);
    return scene;
}

/// The scene for measuring noise: with the samples of each row, at the frame's own moment.
Scene measured_scene(Scene scene) {
    scene.observer.shutter = 0;
    scene.render.light = LightMode::global;
    scene.render.adaptive = 0;
    scene.render.noise = {};
    scene.render.channels = {.depth = false, .position = false, .normal = false, .object = false};
    return scene;
}

/// A scene in its world.
struct Shown {
    const Device& device;
    Scene scene;
    RenderReport report;
    BuiltWorld world;

    Shown(const Device& opened, const GlobalScene& measured) : device(opened) {
        AssetStore assets;
        scene = with_culling(measured_scene(measured.scene), assets);
        world = WorldBuilder(device, false, std::move(assets)).build(scene, report.world);
        device.finish();
    }

    Image image(int first, int samples) {
        scene.render.first_sample = first;
        scene.render.samples = samples;
        Image image = Renderer(device, false).new_image(scene, world, report);
        device.finish();
        return image;
    }
};

References references_of(Shown& shown, const GlobalScene& scene, int max_samples) {
    if (scene.references) return *scene.references;
    const int count = std::min(std::max(kMinReferenceSamples, 2 * max_samples), kMaxSamples);
    return {shown.image(kFirstOfReferences, count), shown.image(2 * kFirstOfReferences, count)};
}

double mean_light(const Image& image) {
    double sum = 0;
    for (const char* color : kColors)
        for (const float value : image.planes.at(color)) sum += double(value);
    return sum / (3.0 * image.width * image.height);
}

double mean_light(const References& references) {
    return (mean_light(references[0]) + mean_light(references[1])) / 2;
}

/// Measures a row without its error, and gives its picture.
GlobalRow measure_row(Shown& shown, int samples, int repeats, Image& image) {
    clear_counters(shown.device);
    image = shown.image(0, samples);
    const DeviceCounters& counters = shown.device.counters();
    const double programs = counters.build_ms / 1e3;
    GlobalRow row;
    row.samples = samples;
    row.times = times_of(shown.report, counters);
    row.peak_bytes = counters.peak_bytes;
    double spent = row.times.image;
    if (programs > 0) row.times.image = INFINITY;
    for (int i = 0; std::isinf(row.times.image) || (i < repeats && spent < kMaxRowSeconds); ++i) {
        clear_counters(shown.device);
        shown.image(0, samples);
        const BenchTimes times = times_of(shown.report, counters);
        spent += times.image;
        if (times.image < row.times.image) row.times = times;
    }
    row.times.programs = programs;
    row.seconds = row.times.image;
    return row;
}

}  // namespace

std::span<const GlobalEntry> global_entries() {
    static constexpr GlobalEntry kEntries[] = {
        {"cornell", "scenes/cornell.json, in global light: its noise", cornell_scene}};
    return kEntries;
}

double relative_mse(const Image& image, const References& references) {
    const double mean = mean_light(references), floor = 0.01 * mean * mean;
    if (mean == 0) return mean_light(image) == 0 ? 0 : NAN;
    double sum = 0;
    size_t count = 0;
    for (const char* color : kColors) {
        const auto& values = image.planes.at(color);
        const auto &a = references[0].planes.at(color), &b = references[1].planes.at(color);
        for (size_t i = 0; i < values.size(); ++i, ++count) {
            const double value = double(values[i]), light = (double(a[i]) + double(b[i])) / 2;
            const double square = (value - double(a[i])) * (value - double(b[i]));
            sum += square / (light * light + floor);
        }
    }
    return sum / double(count);
}

std::vector<GlobalRow> measure_global(const Device& device, const GlobalScene& scene,
                                      std::span<const int> samples, int repeats,
                                      const std::function<void()>& progress) {
    if (samples.empty()) return {};
    device.time_kernels(true);
    Shown shown(device, scene);
    std::vector<GlobalRow> rows;
    std::vector<Image> images(samples.size());
    rows.reserve(samples.size());
    for (size_t i = 0; i < samples.size(); ++i) {
        rows.push_back(measure_row(shown, samples[i], repeats, images[i]));
        rows.back().scene = scene.name;
        progress();
    }
    const References references = references_of(shown, scene, samples.back());
    const double light = mean_light(references);
    for (size_t i = 0; i < rows.size(); ++i) {
        rows[i].relative_mse = relative_mse(images[i], references);
        rows[i].light = light > 0 ? mean_light(images[i]) / light : 0;
    }
    return rows;
}

void check_global(const Device& device, const GlobalScene& scene) {
    const Shown shown(device, scene);
}

std::vector<GlobalFit> fit_global(std::span<const GlobalRow> rows) {
    std::vector<GlobalFit> fits;
    for (const GlobalRow& first : rows) {
        const auto is_same = [&](const auto& other) {
            return other.program == first.program && other.scene == first.scene;
        };
        if (std::ranges::any_of(fits, is_same)) continue;
        std::vector<double> samples, seconds, errors;
        for (const GlobalRow& row : rows) {
            if (!is_same(row)) continue;
            samples.push_back(row.samples);
            seconds.push_back(row.seconds);
            errors.push_back(row.relative_mse);
        }
        fits.push_back(
            {first.program, first.scene, fit_slope(samples, errors), fit_slope(seconds, errors)});
    }
    return fits;
}

}  // namespace voxelume
