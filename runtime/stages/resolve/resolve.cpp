// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/resolve/resolve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "runtime/base/error.hpp"
#include "runtime/grid/grid_arguments.hpp"

namespace voxelume {
namespace {

constexpr const char* kSmallerImage = "render a smaller image";

std::vector<const char*> plane_names(const ImageChannels& channels) {
    std::vector<const char*> names;
    if (channels.color) names = {"R", "G", "B", "A"};
    if (channels.variance) names.insert(names.end(), {"variance.R", "variance.G", "variance.B"});
    if (channels.depth) names.push_back("Z");
    if (channels.distance) names.push_back("distance");
    if (channels.position) names.insert(names.end(), {"P.X", "P.Y", "P.Z"});
    if (channels.normal) names.insert(names.end(), {"N.X", "N.Y", "N.Z"});
    return names;
}

std::vector<const char*> id_plane_names(const ImageChannels& channels) {
    std::vector<const char*> names;
    if (channels.object) names.push_back("objectId");
    if (channels.material) names.push_back("materialId");
    return names;
}

/// Throws for subnormal values, whose sums have lost bits.
void check_exact(const Image& earlier, const char* name) {
    const auto plane = earlier.planes.find(name);
    if (plane == earlier.planes.end()) return;
    const auto is_subnormal = [](float v) { return std::fpclassify(v) == FP_SUBNORMAL; };
    if (std::ranges::any_of(plane->second, is_subnormal))
        throw Error(ErrorKind::input,
                    "the image to which samples are added has values in channel {} that are too "
                    "small to be exact: render it again from the start",
                    name);
}

}  // namespace

Defines resolve_defines(const Device& device, const Features& features,
                        const ImageChannels& channels, bool adds_samples) {
    Defines defines = features.defines(device);
    defines.insert(defines.end(), {{"VXL_SHOWS_COLOR", channels.color},
                                   {"VXL_SHOWS_VARIANCE", channels.variance},
                                   {"VXL_SHOWS_DEPTH", channels.depth},
                                   {"VXL_SHOWS_DISTANCE", channels.distance},
                                   {"VXL_SHOWS_POSITION", channels.position},
                                   {"VXL_SHOWS_NORMAL", channels.normal},
                                   {"VXL_SHOWS_OBJECT", channels.object},
                                   {"VXL_SHOWS_MATERIAL", channels.material},
                                   {"VXL_EARLIER", adds_samples}});
    return defines;
}

ImageArrays allocate_image(const Device& device, const glm::ivec2& size,
                           const ImageChannels& channels) {
    const size_t pixels = size_t(size.x) * size_t(size.y);
    ImageArrays arrays{
        {device, "image", plane_names(channels).size() * pixels, kSmallerImage},
        {device, "object numbers", id_plane_names(channels).size() * pixels, kSmallerImage},
        {device, "not finite", 1}};
    arrays.not_finite.fill(0);
    return arrays;
}

void begin_with(const Image& earlier, const ImageChannels& channels, ImageArrays& arrays) {
    const auto write = [](const auto& planes, const std::vector<const char*>& names, auto& buffer) {
        const size_t pixels = names.empty() ? 0 : buffer.size() / names.size();
        for (size_t i = 0; i < names.size(); ++i) {
            const auto plane = planes.find(names[i]);
            if (plane == planes.end() || plane->second.size() != pixels)
                throw Error(ErrorKind::input,
                            "the image to which samples are added has no channel {} of {} pixels",
                            names[i], pixels);
            buffer.write({plane->second.data(), pixels}, i * pixels);
        }
    };
    for (const char* name : {"R", "G", "B", "A"}) check_exact(earlier, name);
    write(earlier.planes, plane_names(channels), arrays.planes);
    write(earlier.id_planes, id_plane_names(channels), arrays.ids);
}

Image image_in(const ImageArrays& arrays, const glm::ivec2& size, const ImageChannels& channels) {
    Image image;
    image.width = size.x;
    image.height = size.y;
    const size_t pixels = size_t(size.x) * size_t(size.y);
    const std::vector<const char*> names = plane_names(channels), ids = id_plane_names(channels);
    const std::shared_ptr<float> planes = arrays.planes.contents();
    for (size_t i = 0; i < names.size(); ++i)
        image.planes[names[i]] = {std::shared_ptr<float>(planes, planes.get() + i * pixels),
                                  pixels};
    if (ids.empty()) return image;
    const std::shared_ptr<uint32_t> numbers = arrays.ids.contents();
    for (size_t i = 0; i < ids.size(); ++i)
        image.id_planes[ids[i]] = {std::shared_ptr<uint32_t>(numbers, numbers.get() + i * pixels),
                                   pixels};
    return image;
}

ResolveStage::ResolveStage(const Device& device, const Features& features, const Camera& camera,
                           const ImageChannels& channels, ImageArrays arrays, bool adds_samples)
    : camera_(camera),
      arrays_(std::move(arrays)),
      program_(device, "resolve.cl", resolve_defines(device, features, channels, adds_samples)),
      pixels_(program_.kernel("resolve_pixels")) {}

void ResolveStage::pixels(const Pyramid& pyramid, const RayBatch& batch, uint32_t first_tile,
                          uint32_t tiles) {
    const glm::dvec3& o = pyramid.frame.origin;
    const float4 origin = {float(o.x), float(o.y), float(o.z), 0};
    pixels_.launch_packets(size_t(tiles) * 16, camera_, shape_of(pyramid), origin, batch,
                           first_tile, tiles, arrays_.planes, arrays_.ids, arrays_.not_finite);
}

}  // namespace voxelume
