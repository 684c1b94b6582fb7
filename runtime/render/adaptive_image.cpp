// SPDX-License-Identifier: Apache-2.0
// An image whose pixels have one sample, or all where they contrast with their neighbours.
//
// Source: Whitted, "An Improved Illumination Model for Shaded Display", 1980, whose pixels are
// divided where their corners differ. A pixel's bits depend on its neighbours alone, so a part of a
// picture has the bits that it has in the whole.
#include <cmath>

#include "runtime/render/contrast.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene/first_samples.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

/// The pixels that lie in a part of an image, numbered within the part.
std::vector<uint32_t> pixels_in(const std::vector<uint32_t>& pixels, int width, glm::ivec2 first,
                                glm::ivec2 size) {
    std::vector<uint32_t> result;
    for (const uint32_t pixel : pixels) {
        const glm::ivec2 position(int(pixel % uint32_t(width)), int(pixel / uint32_t(width)));
        const glm::ivec2 at = position - first;
        if (at.x >= 0 && at.y >= 0 && at.x < size.x && at.y < size.y)
            result.push_back(uint32_t(at.y) * uint32_t(size.x) + uint32_t(at.x));
    }
    return result;
}

size_t pixel_count(const Image& image) {
    return size_t(image.width) * size_t(image.height);
}

/// Writes each pixel's number of samples.
void show_samples(const std::vector<uint32_t>& pixels, int samples, Image& image) {
    std::vector<float> plane(pixel_count(image), float(kComparedSamples));
    for (const uint32_t pixel : pixels) plane[pixel] = float(samples);
    image.planes["samples"] = std::move(plane);
}

/// Leaves out what was only needed to compare pixels.
void drop_channels(const ImageChannels& asked, Image& image) {
    if (!asked.color)
        for (const char* name : {"R", "G", "B", "A"}) image.planes.erase(name);
    if (!asked.depth) image.planes.erase("Z");
    if (!asked.normal)
        for (const char* name : {"N.X", "N.Y", "N.Z"}) image.planes.erase(name);
    if (!asked.object) image.id_planes.erase("objectId");
}

}  // namespace

/// An image with more samples of the pixels in `sampled`. If it has none yet, chooses the pixels
/// that contrast with their neighbours and returns them in `sampled`.
Image Renderer::adaptive_image(const Scene& scene, const BuiltWorld& world, RenderReport& report,
                               const Tiles& tiles, Sampled& sampled) {
    const RenderSettings& asked = scene.render;
    const int more_samples = asked.samples - kComparedSamples;
    const double per_sample = tiles.weight / asked.samples;
    Scene part = scene;
    part.render.adaptive = 0;
    part.render.samples = kComparedSamples;
    if (!sampled.pixels) part = first_samples_of(scene);
    const glm::ivec2 size = part.render.size;
    TileShare share(tiles.share, tile_count(size.x, size.y), per_sample * kComparedSamples);
    std::vector<TileRange> taken;
    Image image = image_of_tiles(part, world, report, {share, taken});
    tiles.taken.push_back({0, tiles.share.tiles()});
    if (!sampled.pixels) {
        const glm::ivec2 first = asked.crop.first - part.render.crop.first;
        sampled.pixels = contrasting_pixels(image, asked.adaptive, contrast_reach(asked));
        if (size != asked.size) {
            *sampled.pixels = pixels_in(*sampled.pixels, size.x, first, asked.size);
            image = part_of(std::move(image), first, asked.size);
        }
        report.contrasting_pixels = sampled.pixels->size();
    }
    const std::vector<uint32_t>& pixels = *sampled.pixels;
    std::vector<uint32_t> chosen = pixels;
    chosen.resize((pixels.size() + 15) / 16 * 16, VXL_NO_PIXEL);
    const auto more_tiles = uint32_t(chosen.size() / 16);
    if (more_tiles > 0 && !tiles.share.is_closed()) {
        part.render.crop = asked.crop;
        part.render.size = asked.size;
        part.render.first_sample = kComparedSamples;
        part.render.samples = more_samples;
        Renderer renderer(device_, false);
        renderer.is_white_ = is_white_;
        renderer.dilated_occupancy_ = dilated_occupancy_;
        RenderReport of_more;
        TileShare more_share(tiles.share, more_tiles, per_sample * more_samples);
        std::vector<TileRange> more_taken;
        const Image more =
            renderer.image_of_tiles(part, world, of_more, {more_share, more_taken, 1.0, chosen});
        add_samples(pixels, more, kComparedSamples, more_samples, image);
        add_counts(of_more, report);
        report.image_seconds += of_more.image_seconds;
    }
    if (asked.channels.samples) show_samples(pixels, asked.samples, image);
    if (asked.channels.noise)
        image.planes["noise"] = std::vector<float>(pixel_count(image), INFINITY);
    tiles.share.add_work((double(tiles.share.tiles()) - more_tiles) * per_sample * more_samples);
    drop_channels(asked.channels, image);
    return image;
}

}  // namespace voxelume
