// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/place/place_painter.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

/// The distance from a surface, in voxels, up to which world distances are evaluated: `index` reads
/// none beyond it.
constexpr double kBandVoxels = 2.9;

PlacementMap map_of(const PlacedObject& object, const GridFrame& world, Surface surface) {
    const Reach reach = stores_distances(surface)      ? Reach::none
                        : object.set == VoxelSet::thin ? Reach::thin
                                                       : Reach::supercover;
    return placement_map(object.grid->frame, world,
                         object.in_world_frame ? glm::dmat4(1.0) : object.world_from_object, reach,
                         object.object);
}

Program program_for(const Device& device, const PlacedObject& object, Surface surface,
                    const PlacementMap& map, const WorldParts& parts) {
    const ProgramFile files[] = {{"place.cl",
                                  {{"VXL_SMOOTH", stores_distances(surface)},
                                   {"VXL_ATTRIBUTES", parts.has_attributes()},
                                   {"VXL_COLORS", parts.colors},
                                   {"VXL_VOXEL_NORMALS", parts.normals},
                                   {"VXL_OBJECT_ATTRIBUTES", !object.grid->attributes.empty()},
                                   {"VXL_OBJECT_COLORS", !object.grid->colors.empty()},
                                   {"VXL_OBJECT_NORMALS", !object.grid->normals.empty()},
                                   {"VXL_NATIVE_DIVIDE", device.is_cpu()},
                                   {"VXL_REACH", map.has_reach},
                                   {"VXL_KEEPS_INSIDE", object.keeps_inside}}},
                                 {"place_bricks.cl", brick_defines(parts)}};
    Program::build_together(device, files);
    return {device, files[0].file, files[0].defines};
}

/// Half a voxel's diagonal, in distance units of the grid, rounded up.
int half_diagonal(const GridFrame& frame) {
    const glm::dvec3 e = frame.voxel_edge;
    return static_cast<int>(
        std::ceil(glm::length(e) / 2 / std::min({e.x, e.y, e.z}) * kDistanceUnitsPerVoxel));
}

/// The threshold of near leaves: a leaf is near if one of its nodes has a smaller distance, in the
/// object's units. In cells larger than the world's, nodes within the band may be half a diagonal
/// from the next corner.
int near_threshold(const PlacementMap& map, const GridFrame& grid) {
    constexpr double kMaxDistance = kBandVoxels * kDistanceUnitsPerVoxel;
    const double band = kMaxDistance / map.distance_scale;
    const double in_cell = std::min(kMaxDistance, band + half_diagonal(grid));
    return static_cast<int>(std::min(std::ceil(std::max(band, in_cell)), 32767.0));
}

}  // namespace

Surface surface_of(const BrickGrid& grid) {
    if (!grid.distance.empty()) return Surface::smooth;
    return grid.primitive_first.empty() ? Surface::cubes : Surface::exact;
}

bool WorldParts::is_stored_like(const WorldParts& other) const {
    return smooth == other.smooth && occupancy == other.occupancy && colors == other.colors &&
           normals == other.normals && has_attributes() == other.has_attributes();
}

BrickBox bricks_of(const PlacedObject& object, const GridFrame& world) {
    const glm::ivec3 last = world.bricks() - 1;
    if (object.in_world_frame) return {glm::ivec3(0), last};
    const GridFrame& grid = object.grid->frame;
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 end(corner & 1 ? grid.size.x : 0, corner & 2 ? grid.size.y : 0,
                             corner & 4 ? grid.size.z : 0);
        const glm::dvec3 in_object = grid.origin + grid.voxel_edge * end;
        const glm::dvec3 in_world(object.world_from_object * glm::dvec4(in_object, 1));
        const glm::dvec3 voxel = (in_world - world.origin) / world.voxel_edge;
        low = glm::min(low, voxel), high = glm::max(high, voxel);
    }
    // The placement map's reach is at most half an object voxel's diagonal, as the world sees it.
    // Two world voxels cover that and the rounding if the object's voxels are no larger; the margin
    // adds one of the object's voxels along each axis for those that are.
    const glm::dmat3 turn(object.world_from_object);
    glm::dvec3 margin(2);
    for (int axis = 0; axis < 3; ++axis)
        margin += glm::abs(turn[axis]) * grid.voxel_edge[axis] / world.voxel_edge;
    const glm::dvec3 edge(kBrickSize);
    const glm::dvec3 first_brick = glm::floor((low - margin) / edge);
    const glm::dvec3 last_brick = glm::floor((high + margin) / edge);
    return {glm::ivec3(glm::clamp(first_brick, glm::dvec3(0), glm::dvec3(last + 1))),
            glm::ivec3(glm::clamp(last_brick, glm::dvec3(-1), glm::dvec3(last)))};
}

WorldParts parts_of(std::span<const PlacedObject> objects) {
    WorldParts parts;
    for (const PlacedObject& object : objects) {
        const Surface surface = surface_of(*object.grid);
        parts.cubes |= surface == Surface::cubes;
        parts.smooth |= stores_distances(surface);
        parts.occupancy |= !stores_distances(surface);
        parts.colors |= !object.grid->colors.empty();
        parts.normals |= !object.grid->normals.empty();
        parts.transparent |= object.grid->transparent;
        const std::vector<uint32_t> attributes = possible_attributes(object, surface);
        parts.attributes.insert(attributes.begin(), attributes.end());
    }
    return parts;
}

WorldBounds bounds_of(const GridFrame& frame) {
    const glm::dvec3& e = frame.voxel_edge;
    const glm::dvec3 units = e / std::min({e.x, e.y, e.z}) * (kDistanceUnitsPerVoxel / 2.0);
    return {glm::ivec4(frame.size, 0), glm::ivec4(glm::round(units), 0)};
}

Painter::Painter(const Device& device, const PlacedObject& object, const GridFrame& world,
                 const WorldParts& parts, NearLeaves& near)
    : object_(object),
      surface_(surface_of(*object.grid)),
      map_(map_of(object, world, surface_)),
      bricks_(bricks_of(object, world)),
      rows_(device, "placement", map_.rows),
      program_(program_for(device, object, surface_, map_, parts)),
      attribute_map_(attribute_map(device, object, surface_)),
      threshold_(near_threshold(map_, object.grid->frame)) {
    const BrickGrid& grid = *object.grid;
    near_ = near.of(grid, threshold_, [&] {
        Buffer<uint64_t> masks(device, "near leaves", grid.brick_count);
        program_.kernel("mark_near_leaves")
            .launch(WorkItem::heavy, grid.brick_count, grid.brick_count, threshold_, grid.occupancy,
                    grid.distance, masks);
        return masks;
    });
}

Buffer<uint64_t> NearLeaves::of(const BrickGrid& grid, int threshold,
                                const std::function<Buffer<uint64_t>()>& mark) {
    const auto [found, is_new] = entries_.try_emplace({&grid, threshold});
    Entry& entry = found->second;
    if (is_new) entry.masks = mark();
    entry.is_used = true;
    return entry.masks;
}

void NearLeaves::begin_list() {
    std::erase_if(entries_, [](const auto& entry) { return !entry.second.is_used; });
    for (auto& [key, entry] : entries_) entry.is_used = false;
}

void bind(KernelArguments& to, const Painter& painter) {
    const BrickGrid& grid = *painter.object_.grid;
    to.add(painter.rows_, painter.map_.fraction_bits, glm::ivec4(grid.frame.bricks(), 0),
           grid.slots, painter.near_, grid.occupancy, grid.distance,
           static_cast<float>(painter.map_.distance_scale), painter.attribute_map_.map,
           painter.attribute_map_.materials, grid.attributes, grid.colors, grid.normals);
}

void bind(KernelArguments& to, const PaintedWorld& painted) {
    const BrickGrid& world = painted.world;
    to.add(glm::ivec4(world.frame.bricks(), 0), bounds_of(world.frame), painted.painted.slots,
           world.coordinates, world.distance, world.occupancy, world.attributes, world.colors,
           world.normals);
}

void Painter::classify(const GridFrame& world, uint32_t count, const Buffer<uint32_t>& listed,
                       const Buffer<uint8_t>& states) {
    program_.kernel("classify_bricks")
        .launch(WorkItem::light, count, count, listed, glm::ivec4(world.bricks(), 0),
                bounds_of(world), *this, states);
}

void Painter::follow(const Device& device, const WorldParts& parts) {
    program_ = program_for(device, object_, surface_, map_, parts);
}

void Painter::paint(const PaintedBricks& painted, BrickGrid& world) {
    if (stores_distances(surface_))
        paint_smooth(painted, world);
    else
        paint_cubes(painted, world);
}

void Painter::paint_smooth(const PaintedBricks& painted, BrickGrid& world) {
    const uint32_t leaves = painted.count * 64;
    const PaintedWorld to{painted, world};
    program_.kernel("paint_distances").launch(WorkItem::heavy, leaves, leaves, *this, to);
    if (world.attributes.empty() && world.colors.empty()) return;
    program_.kernel("paint_smooth_voxels")
        .launch(WorkItem::heavy, leaves, leaves, half_diagonal(world.frame), *this, to);
}

void Painter::paint_cubes(const PaintedBricks& painted, BrickGrid& world) {
    const uint32_t leaves = painted.count * 64;
    program_.kernel("paint_cubes")
        .launch(WorkItem::heavy, leaves, leaves, *this, PaintedWorld{painted, world});
}

void Painter::close_distances(const PaintedBricks& painted, BrickGrid& world) {
    const uint32_t leaves = painted.count * 64;
    program_.kernel("close_distances")
        .launch(WorkItem::light, leaves, leaves, PaintedWorld{painted, world});
}

}  // namespace voxelume
