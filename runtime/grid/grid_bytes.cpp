// SPDX-License-Identifier: Apache-2.0
#include "runtime/grid/grid_bytes.hpp"

#include <cstring>

#include "runtime/opencl/packed_buffers.hpp"

namespace voxelume {
namespace {

struct GridHeader {
    GridFrame frame;
    uint32_t brick_count = 0;
    uint32_t attribute = 0;
    uint64_t transparent = 0;
};
static_assert(std::is_trivially_copyable_v<GridHeader>);

/// Calls `visit` with each buffer of a grid, in the order of their bytes.
template <class Grid, class Visit>
void visit_grid(Grid& grid, const Visit& visit) {
    visit("model slots", grid.slots);
    visit("model coordinates", grid.coordinates);
    visit("model occupancy", grid.occupancy);
    visit("model distances", grid.distance);
    visit("model attributes", grid.attributes);
    visit("model colors", grid.colors);
    visit("source lists", grid.primitive_first);
    visit("source primitives", grid.primitives);
    visit("source triangles", grid.triangles);
    visit("source attributes", grid.triangle_attributes);
    visit("source normals", grid.triangle_normals);
    visit("source solids", grid.solids);
}

}  // namespace

std::optional<std::string> bytes_of_grid(const BrickGrid& grid, uint64_t max_bytes) {
    GridHeader header;
    std::memset(static_cast<void*>(&header), 0, sizeof header);  // the padding is cleared, too
    header.frame.origin = grid.frame.origin;
    header.frame.voxel_edge = grid.frame.voxel_edge;
    header.frame.size = grid.frame.size;
    header.brick_count = grid.brick_count;
    header.attribute = grid.attribute;
    header.transparent = grid.transparent;
    PackedWriter writer(max_bytes);
    writer.put(header);
    visit_grid(grid, [&](const char*, const auto& buffer) { writer.put(buffer); });
    if (writer.is_too_large()) return std::nullopt;
    return writer.take();
}

std::optional<BrickGrid> grid_of_bytes(const Device& device, std::string_view bytes) {
    PackedReader reader(bytes);
    GridHeader header;
    reader.take(header);
    BrickGrid grid;
    grid.frame = header.frame;
    grid.brick_count = header.brick_count;
    grid.attribute = header.attribute;
    grid.transparent = header.transparent != 0;
    visit_grid(grid, [&](const char* name, auto& buffer) { reader.take(device, name, buffer); });
    const glm::ivec3 bricks = grid.frame.bricks();
    const bool fits = grid.slots.size() == size_t(bricks.x) * bricks.y * bricks.z &&
                      grid.coordinates.size() == grid.brick_count;
    if (!reader.is_done() || !fits) return std::nullopt;
    return grid;
}

uint64_t device_bytes(const BrickGrid& grid) {
    uint64_t sum = 0;
    visit_grid(grid, [&]<class T>(const char*, const Buffer<T>& buffer) {
        sum += buffer.size() * sizeof(T);
    });
    return sum;
}

}  // namespace voxelume
