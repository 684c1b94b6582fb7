#include "runtime/batch/device_images.hpp"

#include <algorithm>
#include <exception>
#include <thread>

#include "runtime/analysis/culling.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kPartsPerDevice = 16;  // so that no device waits long for the last one
constexpr int kTileSize = 4;

struct Part {
    Image image;  ///< of which `tiles` are made
    std::vector<TileRange> tiles;
    RenderReport report;
    std::exception_ptr error;
};

Part render_part(const Device& device, const ModelCache& cache, const Scene& scene,
                 TileShare& share) {
    Part part;
    try {
        AssetStore meshes(cache);
        const Scene shown = with_culling(scene, meshes);
        const BuiltWorld world =
            WorldBuilder(device, false, std::move(meshes)).build(shown, part.report.world);
        part.image =
            Renderer(device, false).part_of_image(shown, world, part.report, {share, part.tiles});
    } catch (...) {
        part.error = std::current_exception();
        share.close();
    }
    return part;
}

template <class Value>
void copy_tile(const Image& image, uint32_t tile, const Plane<Value>& from, Plane<Value>& to) {
    const uint32_t tiles_x = uint32_t(image.width + kTileSize - 1) / kTileSize;
    const int x = int(tile % tiles_x) * kTileSize, y = int(tile / tiles_x) * kTileSize;
    const int end_x = std::min(x + kTileSize, image.width);
    const int end_y = std::min(y + kTileSize, image.height);
    for (int row = y; row < end_y; ++row) {
        const size_t start = size_t(row) * size_t(image.width);
        std::copy(from.begin() + int64_t(start) + x, from.begin() + int64_t(start) + end_x,
                  to.begin() + int64_t(start) + x);
    }
}

void copy_tiles(const Part& part, Image& image) {
    for (const TileRange& range : part.tiles)
        for (uint32_t tile = range.first; tile < range.first + range.count; ++tile) {
            for (auto& [name, plane] : image.planes)
                copy_tile(image, tile, part.image.planes.at(name), plane);
            for (auto& [name, plane] : image.id_planes)
                copy_tile(image, tile, part.image.id_planes.at(name), plane);
        }
}

void add_report(const RenderReport& part, RenderReport& sum) {
    const auto seconds = [](const WorldReport& world) {
        return world.load_seconds + world.voxelize_seconds + world.place_seconds +
               world.index_seconds + world.keep_seconds;
    };
    if (seconds(part.world) > seconds(sum.world)) sum.world = part.world;
    sum.image_seconds = std::max(sum.image_seconds, part.image_seconds);
    sum.voxels = part.voxels;
    sum.world_bytes = part.world_bytes;
    add_counts(part, sum);
}

}  // namespace

Image render_together(const DeviceGroup& group, const Scene& scene, RenderReport& report,
                      const FrameProgress& progress) {
    const uint32_t tiles = tile_count(scene.render.size.x, scene.render.size.y);
    const uint32_t parts_wanted = kPartsPerDevice * uint32_t(group.devices.size());
    TileShare share(tiles, progress, std::max(tiles / parts_wanted, 1u));
    std::vector<Part> parts(group.devices.size());
    {
        std::vector<std::jthread> threads;
        for (size_t i = 0; i < parts.size(); ++i)
            threads.emplace_back(
                [&, i] { parts[i] = render_part(group.devices[i], group.cache, scene, share); });
    }
    for (const Part& part : parts)
        if (part.error) std::rethrow_exception(part.error);
    Image image = parts[0].image;
    for (const Part& part : parts) {
        copy_tiles(part, image);
        add_report(part.report, report);
    }
    return image;
}

}  // namespace voxelume
