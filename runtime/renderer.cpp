#include "runtime/renderer.hpp"

#include <algorithm>
#include <chrono>

#include "runtime/illumination.hpp"
#include "runtime/stages/resolve.hpp"
#include "runtime/stages/sight.hpp"

namespace voxelume {
namespace {

template <class... T>
uint64_t sum_of_bytes(const Buffer<T>&... buffers) {
    return (uint64_t(buffers.size() * sizeof(T)) + ...);
}

uint64_t bytes_of(const Pyramid& p) {
    return sum_of_bytes(p.sectors, p.bricks, p.leaves, p.leaf_voxels, p.attributes, p.colors,
                        p.fields, p.primitive_first, p.primitives, p.triangles,
                        p.triangle_attributes, p.solids);
}

}  // namespace

Image render(const Device& device, const Scene& scene, RenderReport& report,
             const std::function<void(uint32_t, uint32_t)>& progress) {
    const Pyramid world = form_world(device, scene, report.world);
    const auto start = std::chrono::steady_clock::now();
    const Features features = features_of(scene, world);
    const Sight observer = sight_of(scene, world.frame);

    const uint32_t tiles = tile_count(observer.width, observer.height);
    const uint32_t rays_per_tile = 16 * uint32_t(observer.samples);
    const uint32_t batch_tiles = std::clamp(batch_rays(features) / rays_per_tile, 1u, tiles);
    RayBatch batch = allocate_batch(device, features, batch_tiles * rays_per_tile);

    SightStage sight(device, features, observer);
    Illumination illumination(device, features, scene, world, batch.stride);
    ResolveStage resolve(device, features, observer);
    for (uint32_t first = 0; first < tiles; first += batch_tiles) {
        const uint32_t now = std::min(batch_tiles, tiles - first);
        const uint32_t rays = sight.cast(shape_of(world), first, now, batch);
        illumination.light(batch, rays);
        resolve.pixels(world, batch, first, now);
        report.sight_rays += rays;
        if (progress) {
            device.finish();
            progress(first + now, tiles);
        }
    }
    Image image = resolve.image();
    report.not_finite = resolve.not_finite();
    report.shadow_rays = illumination.shadow_rays();
    report.secondary_rays = illumination.secondary_rays();
    report.ended_paths = illumination.ended_paths();
    report.lost_members = illumination.lost_members();
    report.voxels = world.voxel_count;
    report.world_bytes = bytes_of(world);
    report.image_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return image;
}

}  // namespace voxelume
