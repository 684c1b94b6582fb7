// SPDX-License-Identifier: Apache-2.0
#include "runtime/grid/grid_bytes.hpp"

#include "runtime/grid/packed_grid.hpp"

namespace voxelume {
namespace {

/// Calls `visit` with each buffer of a grid, in the order of their bytes.
template <class Grid, class Visit>
void visit_grid(Grid& grid, const Visit& visit) {
    visit("model slots", grid.slots);
    visit("model coordinates", grid.coordinates);
    visit("model occupancy", grid.occupancy);
    visit("model distances", grid.distance);
    visit("model attributes", grid.attributes);
    visit("model colors", grid.colors);
    visit("model normals", grid.normals);
    visit("source lists", grid.primitive_first);
    visit("source primitives", grid.primitives);
    visit("source triangles", grid.triangles);
    visit("source attributes", grid.triangle_attributes);
    visit("source normals", grid.triangle_normals);
    visit("source texture places", grid.triangle_textures);
    visit("source textures", grid.textures);
    visit("source solids", grid.solids);
}

/// Calls its argument with each buffer of a grid.
auto grid_buffers(auto& grid) {
    return [&grid](const auto& visit) { visit_grid(grid, visit); };
}

}  // namespace

std::optional<std::string> bytes_of_grid(const BrickGrid& grid, uint64_t max_bytes) {
    const std::array<uint32_t, 5> counts{
        grid.brick_count, grid.attribute,
        uint32_t(grid.transparent) | uint32_t(grid.texture_alpha) << 1 |
            uint32_t(grid.texture_maps) << 2,
        uint32_t(grid.texture_key), uint32_t(grid.texture_key >> 32)};
    return packed_bytes({grid.frame, counts}, grid_buffers(grid), max_bytes);
}

std::optional<BrickGrid> grid_of_bytes(const Device& device, std::string_view bytes) {
    BrickGrid grid;
    const auto header = unpack_bytes(device, bytes, grid_buffers(grid));
    if (!header) return std::nullopt;
    grid.frame = header->frame;
    grid.brick_count = header->counts[0];
    grid.attribute = header->counts[1];
    grid.transparent = (header->counts[2] & 1) != 0;
    grid.texture_alpha = (header->counts[2] & 2) != 0;
    grid.texture_maps = (header->counts[2] & 4) != 0;
    grid.texture_key = header->counts[3] | uint64_t{header->counts[4]} << 32;
    const glm::ivec3 bricks = grid.frame.bricks();
    const bool fits = grid.slots.size() == size_t(bricks.x) * bricks.y * bricks.z &&
                      grid.coordinates.size() == grid.brick_count;
    return fits ? std::optional(std::move(grid)) : std::nullopt;
}

uint64_t device_bytes(const BrickGrid& grid) {
    uint64_t bytes = buffer_bytes(grid_buffers(grid));
    for (const GridPart& part : grid.parts) bytes += device_bytes(*part.grid);
    return bytes;
}

}  // namespace voxelume
