// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/count_world.hpp"

#include <algorithm>
#include <set>

#include "runtime/grid/sector_table.hpp"
#include "runtime/stages/brick_arrays.hpp"
#include "runtime/stages/index/index_marks.hpp"
#include "runtime/stages/instance/instance_pools.hpp"
#include "runtime/stages/place/place_exact.hpp"
#include "runtime/stages/place/place_painter.hpp"

namespace voxelume {
namespace {

/// The mean numbers of a surface's voxels in each leaf, and in each sector, that it passes.
constexpr double kVoxelsPerLeaf = 11, kVoxelsPerSector = 4096;

/// Follows the painters of objects, which share the buffers that depend on the grid alone.
std::vector<Buffer<uint64_t>> count_painters(const Device& device,
                                             std::span<const PlacedObject> objects) {
    std::vector<Buffer<uint64_t>> painters;
    std::set<const BrickGrid*> grids;
    for (const PlacedObject& object : objects)
        if (grids.insert(object.grid).second)
            painters.emplace_back(device, "near leaves", object.grid->brick_count);
    return painters;
}

/// Follows WorldBricks::store and reserve.
void count_bricks_of(const Device& device, const WorldParts& parts, size_t bricks,
                     BrickGrid& world) {
    world.brick_count = uint32_t(bricks);
    if (parts.occupancy) world.occupancy = allocate_masks(device, "world occupancy", bricks);
    if (parts.smooth) world.distance = allocate_distances(device, "world distances", bricks);
    if (parts.has_attributes())
        world.attributes = allocate_words(device, "world attributes", bricks);
    if (parts.colors) world.colors = allocate_words(device, "world colors", bricks);
    if (parts.normals) world.normals = allocate_words(device, "world voxel normals", bricks);
    world.slots = allocate_slots(device, "world slots", world.frame);
    world.coordinates = Buffer<uint32_t>(device, "world coordinates", bricks);
}

/// Follows Placer's painting.
void count_painting(const Device& device, size_t bricks) {
    const Buffer<uint32_t> painted(device, "painted bricks", bricks);
}

/// The capacity of arrays in bricks, once they have grown.
size_t with_more_room(size_t bricks) {
    return bricks + bricks / 4;
}

/// Makes the world's triangles and solids; false if no object has any.
bool count_sources(const Device& device, std::span<const PlacedObject> objects, BrickGrid& world) {
    SourceCounts sources;
    bool is_exact = false;
    for (const PlacedObject& object : objects) {
        is_exact |= !object.grid->primitive_first.empty();
        sources.add(*object.grid);
    }
    if (is_exact) allocate_sources(device, sources, world);
    return is_exact;
}

/// Follows join_exact_surfaces.
void count_lists(const Device& device, std::span<const PlacedObject> objects, size_t primitives,
                 BrickGrid& world) {
    if (!count_sources(device, objects, world)) return;
    const Buffer<uint32_t> counts = allocate_words(device, "primitive counts", world.brick_count);
    world.primitives = Buffer<uint32_t>(device, "world primitives", primitives);
    world.primitive_first =
        allocate_list_starts(device, "world primitive starts", world.brick_count);
    const Buffer<uint32_t> starts(device, "brick starts", world.brick_count);
}

bool is_smooth(const PlacedObject& object) {
    return stores_distances(surface_of(*object.grid));
}

bool has_parts(const PlacedObject& object) {
    return !object.grid->parts.empty();
}

/// Follows WorldPlacer's fields: makes their grids, and returns the other objects.
std::vector<PlacedObject> count_fields(const Device& device, std::span<const PlacedObject> objects,
                                       size_t bricks, CountedWorld& world) {
    std::vector<PlacedObject> others, smooth;
    for (const PlacedObject& object : objects)
        (is_smooth(object) ? smooth : others).push_back(object);
    const auto own = [](const PlacedObject& object) { return !object.grid->attributes.empty(); };
    const auto colored = [](const PlacedObject& object) { return !object.grid->colors.empty(); };
    world.fields.brick_count = uint32_t(bricks);
    for (const PlacedObject& object : smooth)
        if (has_parts(object)) world.fields.parts = object.grid->parts;
    world.fields.distance = allocate_distances(device, "world distances", bricks);
    if (std::ranges::any_of(smooth, own))
        world.fields.attributes = allocate_words(device, "world attributes", bricks);
    if (std::ranges::any_of(smooth, colored))
        world.fields.colors = allocate_words(device, "world colors", bricks);
    world.parts = {
        .attributes = true, .colors = std::ranges::any_of(objects, colored), .fields = true};
    return others;
}

}  // namespace

CountedWorld count_placing(const Device& device, std::span<const PlacedObject> objects,
                           const GridFrame& frame, const WorldCounts& counts) {
    CountedWorld world;
    world.painters = count_painters(device, objects);
    {
        const Buffer<uint8_t> states(device, "brick states", brick_slots(frame));
        const Buffer<uint32_t> listed(device, "listed bricks", counts.bricks);
    }
    std::vector<PlacedObject> others(objects.begin(), objects.end());
    size_t bricks = counts.bricks;
    if (std::ranges::any_of(objects, objects.size() > 1 ? is_smooth : has_parts)) {
        others = count_fields(device, objects, std::max(counts.field_bricks, size_t{1}), world);
        bricks = counts.other_bricks;
    }
    const WorldParts parts = parts_of(others);
    BrickGrid& grid = world.grid;
    grid.frame = frame;
    grid.transparent = parts.transparent;
    grid.cubes = parts.cubes;
    grid.attribute = parts.attributes.size() == 1 ? *parts.attributes.begin() : 0;
    count_bricks_of(device, parts, bricks, grid);
    count_painting(device, counts.bricks);
    count_lists(device, others, counts.primitives, grid);
    world.parts.exact = !grid.primitive_first.empty();
    world.parts.normals = !grid.normals.empty();
    return world;
}

void count_growth(const Device& device, BrickGrid& world) {
    const size_t bricks = with_more_room(world.brick_count);
    if (!world.occupancy.empty())
        world.occupancy = allocate_masks(device, "world occupancy", bricks);
    if (!world.distance.empty())
        world.distance = allocate_distances(device, "world distances", bricks);
    if (!world.attributes.empty())
        world.attributes = allocate_words(device, "world attributes", bricks);
    if (!world.colors.empty()) world.colors = allocate_words(device, "world colors", bricks);
    if (!world.normals.empty())
        world.normals = allocate_words(device, "world voxel normals", bricks);
}

BrickGrid count_repainting(const Device& device, std::span<const PlacedObject> objects,
                           const CountedWorld& world, const PartBricks& bricks) {
    { const Buffer<uint8_t> states(device, "brick states", brick_slots(world.grid.frame)); }
    count_painting(device, size_t(std::max(bricks.of_fields, bricks.of_others)));
    std::vector<PlacedObject> others(objects.begin(), objects.end());
    CountedWorld changed;  // new grids of smooth objects coexist with the old ones here
    if (world.fields.brick_count > 0)
        others = count_fields(device, objects, size_t(bricks.of_fields), changed);
    // New lists replace old ones, but pyramids keep the sources of old lists.
    BrickGrid sources;
    if (count_sources(device, others, sources))
        const Buffer<uint32_t> counts =
            allocate_words(device, "primitive counts", world.grid.brick_count);
    return sources;
}

namespace {

PyramidCounts pyramid_counts(const GridFrame& frame, const WorldCounts& counts) {
    const glm::dvec3 sectors(frame.sectors());
    PyramidCounts found;
    found.sectors = size_t(
        std::min(sectors.x * sectors.y * sectors.z, 8 + double(counts.voxels) / kVoxelsPerSector));
    found.leaves = size_t(double(counts.voxels) / kVoxelsPerLeaf);
    found.voxels = counts.voxels;
    found.primitives = counts.primitives;
    return found;
}

/// Marks and packs the voxels of a grid.
Pyramid count_packing(const Device& device, const BrickGrid& grid, const WorldCounts& counts) {
    { const MarkArrays marks = allocate_marks(device, grid.brick_count); }
    Pyramid pyramid = allocate_pyramid(device, grid, pyramid_counts(grid.frame, counts));
    const Buffer<uint32_t> starts(device, "index starts", 3 * size_t(grid.brick_count));
    return pyramid;
}

/// Follows FieldIndexer::index, without the marks that are kept.
Pyramid count_uniting(const Device& device, const CountedWorld& world, const WorldCounts& counts) {
    const size_t bricks = world.fields.brick_count;
    { const MarkArrays marks = allocate_marks(device, bricks); }
    const Buffer<uint64_t> joined = allocate_masks(device, "field masks", bricks);
    if (!world.fields.parts.empty())
        const Buffer<uint64_t> inside = allocate_masks(device, "inside masks", bricks);
    const Buffer<uint64_t> united = allocate_masks(device, "united masks", counts.bricks);
    const Buffer<uint64_t> listing = allocate_masks(device, "list masks", counts.bricks);
    const Buffer<uint64_t> of_base =
        allocate_masks(device, "base masks", world.grid.brick_count > 0 ? counts.bricks : 0);
    Pyramid pyramid =
        allocate_pyramid(device, world.grid, world.parts, pyramid_counts(world.grid.frame, counts));
    const Buffer<uint32_t> starts(device, "index starts", 4 * counts.bricks);
    return pyramid;
}

}  // namespace

CountedPyramid count_index(const Device& device, const BrickGrid& grid, const WorldCounts& counts) {
    CountedPyramid indexed;
    indexed.masks = allocate_masks(device, "index masks", grid.brick_count);
    indexed.pyramid = count_packing(device, grid, counts);
    return indexed;
}

CountedPyramid count_index(const Device& device, const CountedWorld& world,
                           const WorldCounts& counts) {
    if (world.fields.brick_count == 0) return count_index(device, world.grid, counts);
    CountedPyramid indexed;
    indexed.masks = allocate_masks(device, "index masks", world.fields.brick_count);
    indexed.pyramid = count_uniting(device, world, counts);
    return indexed;
}

Pyramid count_reindexing(const Device& device, const CountedWorld& world, const WorldCounts& counts,
                         Buffer<uint64_t>& masks) {
    if (world.fields.brick_count > 0) return count_uniting(device, world, counts);
    masks = allocate_masks(device, "index masks", with_more_room(world.grid.brick_count));
    return count_packing(device, world.grid, counts);
}

namespace {

/// Follows index_model.
Pyramid count_model_index(const Device& device, const BrickGrid& grid, const WorldCounts& counts) {
    if (grid.parts.empty()) return count_index(device, grid, counts).pyramid;
    CountedWorld world;
    world.parts = {.attributes = true, .fields = true};
    world.grid.frame = grid.frame;
    world.fields.brick_count = grid.brick_count;
    world.fields.parts = grid.parts;
    return count_index(device, world, counts).pyramid;
}

}  // namespace

Pyramid count_joining(const Device& device, const ListedInstances& listed, const Pyramid& world,
                      std::span<const WorldCounts> counts, std::vector<ModelPyramid>& kept) {
    if (listed.list.empty()) return world;
    for (size_t i = 0; i < listed.grids.size(); ++i)
        kept.push_back({.pyramid = count_model_index(device, *listed.grids[i], counts[i])});
    Pyramid joined = allocate_joined(device, world, kept);
    joined.instances.list = listed.list;
    for (const ModelPyramid& model : kept)
        joined.instances.counted.push_back(model.pyramid.records());
    joined.instances.records = Buffer<InstanceRecord>(device, "instances", listed.list.size());
    joined.instances.nodes = Buffer<InstanceNode>(device, "instance tree", 2 * listed.list.size());
    return joined;
}

}  // namespace voxelume
