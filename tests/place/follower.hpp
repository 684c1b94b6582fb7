// SPDX-License-Identifier: Apache-2.0
// A placer and an indexer that follow a world as its objects change, compared with placing
// everything from scratch.
#pragma once

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "runtime/geometry/solid/solid_bounds.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/place/placed_world.hpp"
#include "runtime/stages/voxelize/voxelize_solid.hpp"
#include "tests/place/placing.hpp"

namespace voxelume {

inline constexpr double kEdge = 0.02;

inline GridFrame world_of(int voxels) {
    return frame_at(glm::dvec3(-1), glm::dvec3(kEdge), glm::ivec3(voxels));
}

inline BrickGrid ball(double radius, Surface surface, VoxelSet set = VoxelSet::solid) {
    Solid solid;
    solid.radius = radius;
    const GridFrame frame = frame_around(solid, glm::dmat4(1), glm::dvec3(kEdge), 4, {});
    return voxelize_solid(shared_device(), solid, glm::dmat4(1), frame, {surface, set});
}

inline PlacedObject at(const BrickGrid& grid, uint32_t number, const glm::dvec3& position) {
    return {.grid = &grid,
            .world_from_object = glm::translate(glm::dmat4(1), position),
            .object = number,
            .material_of_group = {number % 3}};
}

/// The attributes of all voxels; a pyramid whose voxels have equal attributes stores them only
/// once.
inline std::vector<uint32_t> attributes_of(const Pyramid& p) {
    if (p.attributes.empty()) return std::vector<uint32_t>(p.voxel_count, p.attribute);
    return p.attributes.read();
}

/// All buffers of a world's pyramid that rays read.
inline std::vector<std::vector<uint32_t>> buffers_of(const Pyramid& p) {
    return {p.sectors.read(),    p.bricks.read(),
            p.leaves.read(),     p.leaf_voxels.read(),
            attributes_of(p),    p.colors.read(),
            p.fields.read(),     p.primitive_first.read(),
            p.primitives.read(), p.triangle_attributes.read(),
            p.solids.read(),     {p.voxel_count, p.listed_fields}};
}

/// A placer, and an indexer that follows it.
struct Follower {
    WorldPlacer placer{shared_device()};
    Indexer indexer{shared_device()};

    Pyramid pyramid_of(const std::vector<PlacedObject>& objects, const GridFrame& frame) {
        const PlacedWorld& world = placer.place(objects, frame);
        return indexer.index(world, placer.changed_bricks());
    }
};

/// The number of bricks that a world stores, including the bricks of fields.
inline uint32_t bricks_of(const PlacedWorld& world) {
    uint32_t sum = world.voxels.brick_count;
    for (const PlacedField& field : world.fields) sum += field.grid.brick_count;
    return sum;
}

inline void expect_as_placed_afresh(Follower& follower, const std::vector<PlacedObject>& objects,
                                    const GridFrame& frame, const std::string& what) {
    const PlacedWorld afresh = place_world(shared_device(), objects, frame);
    EXPECT_EQ(buffers_of(follower.pyramid_of(objects, frame)),
              buffers_of(Indexer(shared_device()).index(afresh, nullptr)))
        << what;
}

}  // namespace voxelume
