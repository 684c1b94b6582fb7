// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/image_bands.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "runtime/base/error.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/memory/count/solid_extents.hpp"
#include "runtime/scene/shutter.hpp"

namespace voxelume {
namespace {

/// An image that takes less than this part of the memory needs no bands: if it doesn't fit, its
/// world is too large.
constexpr double kSmallPart = 1.0 / 16;

bool is_small(const Scene& scene, const DeviceInfo& device) {
    const double there = std::min(double(device.memory), double(main_memory()) - kDriverBytes);
    const double bytes = image_bytes(scene.render);
    return bytes <= kSmallPart * there && bytes <= double(device.max_allocation);
}

/// The number of an image's planes that its device doesn't have: parts of the light, and what tells
/// of samples.
int other_planes(const Scene& scene) {
    const ImageChannels& channels = scene.render.channels;
    std::set<std::string> groups;
    for (const Light& light : scene.lights) groups.insert(light.group);
    const int passes = int(channels.albedo) + int(channels.direct) + int(channels.indirect) +
                       int(channels.shadow) + (channels.light_groups ? int(groups.size()) + 1 : 0);
    return 3 * passes + int(channels.samples) + int(channels.noise);
}

/// The bytes of other arrays in main memory while a band is written: planes of the light's parts,
/// other samples, and chunks of files.
double writing_bytes(const Scene& scene) {
    const int planes = other_planes(scene);
    const int again =
        scene.render.noise.is_given() ? 4 + 3 * int(scene.render.channels.variance) : 0;
    const double row =
        image_bytes(scene.render) / scene.render.size.y + 4.0 * planes * scene.render.size.x;
    return 2 * 4.0 * (planes + again) * scene.render.size.x * scene.render.size.y +
           exr_band_bytes(row);
}

}  // namespace

double kept_image_bytes(const Scene& scene) {
    const glm::dvec2 size(scene.render.size);
    return image_bytes(scene.render) + 4.0 * other_planes(scene) * size.x * size.y;
}

uint64_t bytes_of_views(const Scene& scene, int views) {
    const double bytes = views * kept_image_bytes(scene), there = double(main_memory());
    if (bytes + kDriverBytes > there)
        throw Error(ErrorKind::limit,
                    "{} views of {}x{} pixels take {} of main memory, of which this process may "
                    "take {}, and {} of that for the program and its OpenCL driver: ask for "
                    "smaller views, for fewer, or for fewer channels",
                    views, scene.render.size.x, scene.render.size.y, bytes_text(bytes),
                    bytes_text(there), bytes_text(kDriverBytes));
    return uint64_t(bytes);
}

double process_bytes(const Scene& scene, const ScenePlan& plan, double device_bytes,
                     const DeviceInfo& device) {
    return rendering_bytes(plan, device_bytes, device) +
           (scene.render.shows_image ? writing_bytes(scene) : 0);
}

namespace {

/// True if the expected memory of a run is available.
bool fits_surely(const Scene& scene, const ScenePlan& plan, size_t frames,
                 const DeviceInfo& device) {
    const double memory = double(device.memory);
    const double max_bytes = plan.run_bytes(worlds_of(scene, frames), memory);
    const double host = process_bytes(scene, plan, max_bytes, device);
    return max_bytes <= memory && host <= double(main_memory()) &&
           !is_refused({1, scene, plan}, device);
}

/// Cuts into at most `count` bands: rounding their rows up may make fewer.
ImageBands cut(int height, int count) {
    const int rows = (height + count - 1) / count;
    const int rounded = (rows + kBandRows - 1) / kBandRows * kBandRows;
    return {rounded, (height + rounded - 1) / rounded};
}

/// Halves the bands of an image until `fits` accepts their scene and plan; one band if none fits.
template <class Fits>
ImageBands halve(const Scene& scene, AssetStore& meshes, const DeviceInfo& device,
                 const Fits& fits) {
    const int height = scene.render.size.y;
    SolidExtents solids;
    const auto do_fit = [&](const ImageBands& bands) {
        const Scene band = band_of(scene, bands, 0);
        return fits(band, plan_scene(band, meshes, device, solids));
    };
    if (!do_fit(cut(height, height))) return {height, 1};
    ImageBands bands = cut(height, 2);
    for (int count = 4; !bands.are_one() && !do_fit(bands); count *= 2) bands = cut(height, count);
    return bands;
}

}  // namespace

Scene band_of(const Scene& scene, const ImageBands& bands, int band) {
    Scene part = scene;
    if (bands.are_one()) return part;
    const glm::ivec2 size = scene.render.size, first = scene.render.crop.first;
    const int row = band * bands.rows;
    crop(part, {first.x, first.y + row}, {size.x, std::min(bands.rows, size.y - row)});
    return part;
}

ImageBands bands_that_fit(const Scene& scene, std::span<const int> frames, AssetStore& meshes,
                          const DeviceInfo& device, int at_once) {
    const ImageBands one{scene.render.size.y, 1};
    if (!scene.render.shows_image || is_small(scene, device)) return one;
    const FramePlan whole = plan_frames(scene, frames, meshes, device);
    const auto surely = [&](const Scene& band, const ScenePlan& plan) {
        return fits_surely(band, plan, frames.size(), device);
    };
    if (surely(whole.scene, whole.plan)) return one;
    const bool are_needed = is_refused(whole, device);
    ImageBands bands = halve(whole.scene, meshes, device, surely);
    if (bands.are_one() && are_needed)
        bands = halve(whole.scene, meshes, device, [&](const Scene& band, const ScenePlan& plan) {
            return !is_refused({1, band, plan}, device);
        });
    if (!bands.are_one()) bands = cut(scene.render.size.y, bands.count * at_once);
    bands.are_needed = are_needed;
    return bands;
}

std::optional<NeedOfWhole> need_of_whole(const RenderSettings& render) {
    if (render.noise.seconds > 0)
        return NeedOfWhole{"its time is shared by all of its pixels",
                           "ask for a noise or for samples instead of a time"};
    return {};
}

void refuse_bands(const Scene& scene, const DeviceInfo& device, const NeedOfWhole& need) {
    throw Error(ErrorKind::limit,
                "an image of {}x{} pixels doesn't fit the memory of \"{}\" at once, nor can it be "
                "rendered in bands, for {}: {}, or render a smaller one",
                scene.render.size.x, scene.render.size.y, device.name, need.reason, need.advice);
}

}  // namespace voxelume
