// SPDX-License-Identifier: Apache-2.0
#include "runtime/batch/image_parts.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

constexpr int kTileSize = 4;

template <class Value>
void copy_tile(const Image& image, uint32_t tile, const Plane<Value>& from, Plane<Value>& to) {
    const uint32_t tiles_x = uint32_t(image.width + kTileSize - 1) / kTileSize;
    const int x = int(tile % tiles_x) * kTileSize, y = int(tile / tiles_x) * kTileSize;
    const int end_x = std::min(x + kTileSize, image.width);
    const int end_y = std::min(y + kTileSize, image.height);
    for (int row = y; row < end_y; ++row) {
        const int64_t start = int64_t(row) * image.width;
        std::copy(from.begin() + start + x, from.begin() + start + end_x, to.begin() + start + x);
    }
}

void copy_tiles(const ImagePart& part, Image& image) {
    for (const TileRange& range : part.tiles)
        for (uint32_t tile = range.first; tile < range.first + range.count; ++tile) {
            for (auto& [name, plane] : image.planes)
                copy_tile(image, tile, part.image.planes.at(name), plane);
            for (auto& [name, plane] : image.id_planes)
                copy_tile(image, tile, part.image.id_planes.at(name), plane);
        }
}

double seconds_of(const WorldReport& world) {
    return world.load_seconds + world.voxelize_seconds + world.place_seconds + world.index_seconds +
           world.keep_seconds;
}

}  // namespace

void add_report(const RenderReport& part, RenderReport& sum) {
    const uint64_t meshes_read = std::max(part.world.meshes_read, sum.world.meshes_read);
    if (seconds_of(part.world) > seconds_of(sum.world)) sum.world = part.world;
    sum.world.meshes_read = meshes_read;
    sum.image_seconds = std::max(sum.image_seconds, part.image_seconds);
    sum.moments = std::max(sum.moments, part.moments);
    sum.voxels = part.voxels;
    sum.world_bytes = part.world_bytes;
    add_counts(part, sum);
}

Image join_parts(std::vector<ImagePart> parts, RenderReport& report) {
    Image image = std::move(parts.front().image);
    uint64_t tiles = 0;
    for (const ImagePart& part : parts)
        for (const TileRange& range : part.tiles) tiles += range.count;
    if (tiles < tile_count(image.width, image.height))
        throw Error(ErrorKind::render, "a device left out tiles of the image; please report this");
    for (const ImagePart& part : std::span(parts).subspan(1)) copy_tiles(part, image);
    for (const ImagePart& part : parts) add_report(part.report, report);
    return image;
}

}  // namespace voxelume
