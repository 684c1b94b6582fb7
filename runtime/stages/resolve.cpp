#include "runtime/stages/resolve.hpp"

#include <array>

#include "runtime/stages/trace.hpp"

namespace voxelume {
namespace {

constexpr std::array kPlanes = {"R", "G", "B", "A", "Z", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z"};

size_t pixel_count(const Sight& sight) {
    return size_t(sight.width) * size_t(sight.height);
}

}  // namespace

ResolveStage::ResolveStage(const Device& device, const Features& features, const Sight& sight)
    : sight_(sight),
      planes_(device, "image", kPlanes.size() * pixel_count(sight)),
      objects_(device, "object numbers", pixel_count(sight)),
      not_finite_(device, "not finite", 1),
      program_(device, "resolve.cl", features.defines(device)),
      pixels_(program_.kernel("resolve_pixels")) {
    not_finite_.fill(0);
}

void ResolveStage::pixels(const Pyramid& pyramid, const RayBatch& batch, uint32_t first_tile,
                          uint32_t tiles) {
    const glm::dvec3& o = pyramid.frame.origin;
    const float4 origin = {float(o.x), float(o.y), float(o.z), 0};
    pixels_.launch(WorkItem::light, size_t(tiles) * 16, sight_, shape_of(pyramid), origin,
                   batch.hits, batch.positions, batch.normals, batch.words, batch.radiance,
                   batch.coverage, first_tile, tiles, batch.stride, planes_, objects_, not_finite_);
}

Image ResolveStage::image() const {
    Image image;
    image.width = sight_.width;
    image.height = sight_.height;
    const size_t pixels = pixel_count(sight_);
    for (size_t i = 0; i < kPlanes.size(); ++i)
        image.planes[kPlanes[i]] = planes_.read(i * pixels, pixels);
    image.id_planes["objectId"] = objects_.read();
    return image;
}

}  // namespace voxelume
