#include "runtime/stages/place.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numeric>
#include <set>

#include "kernels/shared/voxel.h"
#include "runtime/error.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/place_exact.hpp"
#include "runtime/stages/placement_map.hpp"
#include "runtime/stages/placement_words.hpp"

namespace voxelume {
namespace {

/// World distances up to here, in voxels, are worth evaluating: what `index` reads of a surface.
constexpr double kBandVoxels = 2.9;

Surface surface_of(const BrickGrid& grid) {
    if (!grid.distance.empty()) return Surface::smooth;
    return grid.primitive_first.empty() ? Surface::cubes : Surface::exact;
}

/// What the world stores, taken from what its objects have.
struct WorldParts {
    bool smooth = false, occupancy = false, colors = false, transparent = false;
    std::set<uint32_t> words;  ///< that voxels can have
};

/// An object ready to be painted.
struct Painter {
    const PlacedObject* placed;
    Surface surface;
    PlacementMap map;
    Buffer<int64_t> rows;
    Program program;
    WordMap words;
    Buffer<uint64_t> near;  ///< per slot: leaves with voxels, or with distances in the band
};

bool same_frame(const GridFrame& a, const GridFrame& b) {
    return a.origin == b.origin && a.voxel_edge == b.voxel_edge && a.size == b.size;
}

void check_object(const PlacedObject& object, const GridFrame& world) {
    if (object.in_world_frame && !same_frame(object.grid->frame, world))
        throw Error(ErrorKind::scene,
                    "object {}: its voxels have another frame than the world that they were made "
                    "for: voxelize it in the world's frame",
                    object.object);
    if (!object.in_world_frame && surface_of(*object.grid) == Surface::exact)
        throw Error(ErrorKind::scene,
                    "object {}: an exact surface can't be resampled: voxelize it in the world's "
                    "frame",
                    object.object);
    if (object.object > VXL_OBJECT_MASK)
        throw Error(ErrorKind::limit, "object {}: a world holds at most {} objects", object.object,
                    VXL_OBJECT_MASK + 1);
}

WorldParts parts_of(std::span<const PlacedObject> objects) {
    WorldParts parts;
    for (const PlacedObject& object : objects) {
        const Surface surface = surface_of(*object.grid);
        parts.smooth |= surface == Surface::smooth;
        parts.occupancy |= surface != Surface::smooth;
        parts.colors |= !object.grid->colors.empty();
        parts.transparent |= object.grid->transparent;
        const std::vector<uint32_t> words = possible_words(object, surface);
        parts.words.insert(words.begin(), words.end());
    }
    return parts;
}

/// The objects with the loser of every overlap before its winner.
std::vector<const PlacedObject*> painting_order(std::span<const PlacedObject> objects) {
    std::vector<const PlacedObject*> order;
    for (size_t i = objects.size(); i-- > 0;) order.push_back(&objects[i]);
    std::ranges::stable_sort(order, {}, &PlacedObject::priority);
    return order;
}

/// WorldBounds of lib/world_bounds.h.
struct WorldBounds {
    glm::ivec4 size, half_voxel;
};

WorldBounds bounds_of(const GridFrame& frame) {
    const glm::dvec3& e = frame.voxel_edge;
    const glm::dvec3 units = e / std::min({e.x, e.y, e.z}) * (kDistanceUnitsPerVoxel / 2.0);
    return {glm::ivec4(frame.size, 0), glm::ivec4(glm::round(units), 0)};
}

PlacementMap map_of(const PlacedObject& object, const GridFrame& world, Surface surface) {
    const Reach reach = surface == Surface::smooth     ? Reach::none
                        : object.set == VoxelSet::thin ? Reach::thin
                                                       : Reach::supercover;
    return placement_map(object.grid->frame, world,
                         object.in_world_frame ? glm::dmat4(1.0) : object.world_from_object, reach,
                         object.object);
}

Painter prepare(const Device& device, const PlacedObject& object, const GridFrame& world,
                const WorldParts& parts) {
    const BrickGrid& grid = *object.grid;
    const Surface surface = surface_of(grid);
    const PlacementMap map = map_of(object, world, surface);
    const bool smooth = surface == Surface::smooth;
    Painter painter{
        .placed = &object,
        .surface = surface,
        .map = map,
        .rows = Buffer<int64_t>(device, "placement", map.rows),
        .program = Program(device, "place.cl",
                           {{"VXL_SMOOTH", smooth},
                            {"VXL_ATTRIBUTES", parts.words.size() > 1},
                            {"VXL_COLORS", parts.colors},
                            {"VXL_OBJECT_ATTRIBUTES", !grid.attributes.empty()},
                            {"VXL_OBJECT_COLORS", !grid.colors.empty()},
                            {"VXL_WORLD_OCCUPANCY", parts.occupancy},
                            {"VXL_AMONG_SMOOTH", surface == Surface::exact && parts.smooth},
                            {"VXL_REACH", map.has_reach},
                            {"VXL_KEEPS_INSIDE", object.keeps_inside}}),
        .words = word_map(device, object, surface),
        .near = Buffer<uint64_t>(device, "near leaves", grid.brick_count)};
    const double band = std::ceil(kBandVoxels * kDistanceUnitsPerVoxel / map.distance_scale);
    const int threshold = static_cast<int>(std::min(band, 32767.0));
    painter.program.kernel("mark_near_leaves")
        .launch(WorkItem::heavy, grid.brick_count, grid.brick_count, threshold, grid.occupancy,
                grid.distance, painter.near);
    return painter;
}

/// Decides which of the world's bricks are stored, and numbers them in ascending order.
void number_bricks(const Device& device, std::span<Painter> painters, BrickGrid& world) {
    const glm::ivec3 table = world.frame.bricks();
    const auto count = static_cast<uint32_t>(table.x * table.y * table.z);
    const WorldBounds bounds = bounds_of(world.frame);
    Buffer<uint8_t> states(device, "brick states", count);
    states.fill(0);
    for (Painter& painter : painters) {
        const BrickGrid& grid = *painter.placed->grid;
        painter.program.kernel("classify_bricks")
            .launch(WorkItem::light, count, count, glm::ivec4(table, 0), bounds,
                    painter.map.fraction_bits, painter.rows, glm::ivec4(grid.frame.bricks(), 0),
                    grid.slots, painter.near, grid.distance, states);
    }
    constexpr uint8_t kFull = 1, kSurface = 2;  // lib/placed.h
    std::vector<uint32_t> slots(count, kBrickOutside), coordinates;
    const std::vector<uint8_t> found = states.read();
    for (uint32_t brick = 0; brick < count; ++brick) {
        if (found[brick] == kFull) slots[brick] = kBrickInside;
        if (found[brick] != kSurface) continue;
        slots[brick] = static_cast<uint32_t>(coordinates.size());
        coordinates.push_back(brick);
    }
    world.brick_count = static_cast<uint32_t>(coordinates.size());
    world.slots = Buffer<uint32_t>(device, "world slots", slots);
    world.coordinates = Buffer<uint32_t>(device, "world coordinates", coordinates);
}

void allocate(const Device& device, const WorldParts& parts, BrickGrid& world) {
    const size_t voxels = size_t(world.brick_count) * 4096;
    if (parts.occupancy) {
        world.occupancy = Buffer<uint64_t>(device, "world occupancy", voxels / 64);
        world.occupancy.fill(0);
    }
    if (parts.smooth) {
        world.distance = Buffer<int16_t>(device, "world distances", voxels);
        world.distance.fill(32767);
    }
    if (parts.words.size() > 1) {
        world.attributes = Buffer<uint32_t>(device, "world attributes", voxels);
        world.attributes.fill(0);
    } else if (!parts.words.empty()) {
        world.attribute = *parts.words.begin();
    }
    if (parts.colors) {
        world.colors = Buffer<uint32_t>(device, "world colors", voxels);
        world.colors.fill(0xFFFFFF);
        world.transparent = parts.transparent;
    }
}

/// Ends the world's distances at its bounds, by the program of any smooth object's painter.
void close_distances(Painter& painter, BrickGrid& world) {
    const uint32_t leaves = world.brick_count * 64;
    painter.program.kernel("close_distances")
        .launch(WorkItem::light, leaves, leaves, glm::ivec4(world.frame.bricks(), 0),
                bounds_of(world.frame), world.coordinates, world.distance);
}

/// Half a voxel's diagonal, in distance units of the grid.
int half_diagonal(const GridFrame& frame) {
    const glm::dvec3 e = frame.voxel_edge;
    return static_cast<int>(
        std::ceil(glm::length(e) / 2 / std::min({e.x, e.y, e.z}) * kDistanceUnitsPerVoxel));
}

void paint_smooth(Painter& painter, BrickGrid& world, const Buffer<int16_t>& nearest) {
    const BrickGrid& grid = *painter.placed->grid;
    const uint32_t leaves = world.brick_count * 64;
    const glm::ivec4 table(world.frame.bricks(), 0), object_table(grid.frame.bricks(), 0);
    const auto scale = static_cast<float>(painter.map.distance_scale);
    painter.program.kernel("paint_distances")
        .launch(WorkItem::heavy, leaves, leaves, table, painter.map.fraction_bits, painter.rows,
                object_table, grid.slots, painter.near, grid.distance, scale, world.coordinates,
                world.distance);
    if (nearest.empty()) return;
    painter.program.kernel("paint_smooth_voxels")
        .launch(WorkItem::heavy, leaves, leaves, table, bounds_of(world.frame),
                painter.map.fraction_bits, painter.rows, object_table, grid.slots, painter.near,
                grid.distance, scale, half_diagonal(world.frame), painter.words.map,
                painter.words.materials, grid.attributes, grid.colors, world.coordinates,
                world.distance, nearest, world.occupancy, world.attributes, world.colors);
}

void paint_cubes(Painter& painter, BrickGrid& world, const Buffer<int16_t>& nearest) {
    const BrickGrid& grid = *painter.placed->grid;
    const uint32_t leaves = world.brick_count * 64;
    painter.program.kernel("paint_cubes")
        .launch(WorkItem::heavy, leaves, leaves, glm::ivec4(world.frame.bricks(), 0),
                painter.map.fraction_bits, painter.rows, glm::ivec4(grid.frame.bricks(), 0),
                grid.slots, painter.near, grid.occupancy, painter.words.map,
                painter.words.materials, grid.attributes, grid.colors,
                glm::ivec4(world.frame.size, 0), world.coordinates, nearest, world.occupancy,
                world.attributes, world.colors);
}

/// A world that is its only object: its buffers, with its word.
bool is_only_object(std::span<const PlacedObject> objects, const WorldParts& parts) {
    return objects.size() == 1 && objects[0].in_world_frame && parts.words.size() == 1 &&
           !objects[0].keeps_inside && surface_of(*objects[0].grid) != Surface::exact;
}

}  // namespace

BrickGrid place(const Device& device, std::span<const PlacedObject> objects,
                const GridFrame& world) {
    for (const PlacedObject& object : objects) check_object(object, world);
    const WorldParts parts = parts_of(objects);
    BrickGrid result;
    if (is_only_object(objects, parts)) {
        result = *objects[0].grid;
        result.attributes = {};
        result.attribute = *parts.words.begin();
        return result;
    }
    result.frame = world;
    std::vector<Painter> painters;
    for (const PlacedObject* object : painting_order(objects))
        painters.push_back(prepare(device, *object, world, parts));
    number_bricks(device, painters, result);
    allocate(device, parts, result);
    Buffer<int16_t> nearest;  // distance of the nearest smooth surface to each voxel's centre
    if (parts.smooth && (parts.words.size() > 1 || parts.colors || parts.occupancy)) {
        nearest = Buffer<int16_t>(device, "nearest surfaces", size_t(result.brick_count) * 4096);
        nearest.fill(32767);
    }
    for (Painter& painter : painters) {
        if (painter.surface == Surface::smooth)
            paint_smooth(painter, result, nearest);
        else
            paint_cubes(painter, result, nearest);
    }
    const auto smooth = std::ranges::find(painters, Surface::smooth, &Painter::surface);
    if (smooth != painters.end()) close_distances(*smooth, result);
    join_exact_surfaces(device, objects, result);
    return result;
}

}  // namespace voxelume
